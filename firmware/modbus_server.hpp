#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "common/result.hpp"
#include "firmware/register_file.hpp"

namespace cartwright::firmware {

/// Serves a register file over Modbus TCP from a thread of its own. libmodbus waits and retries as it likes:
/// it never runs on the loop's thread.
class ModbusServer {
 public:
  /// Listens at once; port 0 takes a free one.
  static Result<std::unique_ptr<ModbusServer>> listen(const std::string& address, int port,
                                                      RegisterFile registers);
  ~ModbusServer();

  int port() const { return port_; }
  /// Starts answering.
  void start();

 private:
  class Connections;
  explicit ModbusServer(RegisterFile registers);
  void serve();

  RegisterFile registers_;
  std::unique_ptr<Connections> connections_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
  int port_ = 0;
};

}  // namespace cartwright::firmware
