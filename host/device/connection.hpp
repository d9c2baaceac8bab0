#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "common/wire/register_map.hpp"
#include "host/device/trouble.hpp"

struct _modbus;

namespace cartwright::device {

struct Address {
  std::string host = "127.0.0.1";
  int port = wire::kDefaultPort;
  std::string text() const;
};

/// A Modbus TCP connection: registers in, registers out. Knows nothing of what they mean.
class Connection {
 public:
  static Answer<Connection> open(const Address& address);

  /// At most wire::kMostPerRead registers, from consecutive addresses.
  Answer<void> read(std::uint16_t address, std::span<std::uint16_t> into);
  Answer<void> write(std::uint16_t address, std::span<const std::uint16_t> values);

  const Address& address() const { return address_; }

 private:
  struct Close {
    void operator()(_modbus* context) const;
  };
  Connection(std::unique_ptr<_modbus, Close> context, Address address)
      : context_(std::move(context)), address_(std::move(address)) {}
  Trouble explain(int error, const char* doing, std::uint16_t address) const;

  std::unique_ptr<_modbus, Close> context_;
  Address address_;
};

}  // namespace cartwright::device
