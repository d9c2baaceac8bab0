#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/wire/register_map.hpp"
#include "firmware/controller.hpp"
#include "firmware/gain_store.hpp"
#include "firmware/loop.hpp"
#include "firmware/rig_file.hpp"
#include "firmware/settings.hpp"

namespace cartwright::firmware {

/// What a Modbus request gets back: nothing wrong, or the exception of that number.
enum class Answer : std::uint8_t {
  good = 0,
  illegal_function = 1,
  illegal_address = 2,
  illegal_value = 3,
  busy = 6
};

/// What the server keeps for each connection: what it reads through, and nothing that others see.
struct Client {
  std::uint16_t number = 0;
  std::uint16_t recording = 0;
  std::uint64_t page_row = 0;
  std::uint16_t page_rows = 0;
  std::uint32_t page_crc = 0;
  std::vector<std::uint16_t> window;
};

/// The register map with values behind it: what a read finds and what a write does. Knows nothing of sockets.
/// Lives on the server's thread and reaches the loop only through the exchange.
class RegisterFile {
 public:
  using Time = std::chrono::steady_clock::time_point;

  RegisterFile(const RigFile& rig, Exchange& exchange, const Telemetry& telemetry, GainStore gains);

  Client connect();
  void disconnect(const Client& client, Time now);

  Answer read(const Client& client, std::uint16_t address, std::span<std::uint16_t> out) const;
  Answer write(Client& client, std::uint16_t address, std::span<const std::uint16_t> values, Time now);

  /// A request of any kind came from this client.
  void heard(const Client& client, Time now);
  /// To be called often: notices a commanding client gone silent, and an armed controller left alone.
  void watch(Time now);

 private:
  double number(wire::Id id, const Client& client, const Status& status,
                const RecordingEntry& recording) const;
  double gain_number(wire::Id id) const;
  double online_number(wire::Id id, const Status& status) const;
  double recording_number(wire::Id id, const Client& client, const RecordingEntry& recording) const;
  std::string text(wire::Id id, const Status& status, const RecordingEntry& recording) const;
  RecordingEntry recording_of(const Client& client, const Status& status) const;
  void turn_page(Client& client, std::uint64_t row) const;
  void command();
  void answer(wire::Ack ack, wire::Reason reason, std::string text);
  void lose_owner(Time now);
  void tell_notices();

  RigFile rig_;
  Exchange& exchange_;
  const Telemetry& telemetry_;
  GainStore gains_;
  Settings settings_;
  std::uint16_t last_client_ = 0, owner_ = 0;
  std::uint32_t notices_told_ = 0;
  Time owner_heard_{}, unattended_since_{};

  // The server's own answer to the last command; `none` where the loop answers.
  wire::Ack own_ack_ = wire::Ack::none;
  wire::Reason own_reason_ = wire::Reason::none;
  std::uint16_t own_sequence_ = 0;
  std::string own_text_;
  Request request_;
};

}  // namespace cartwright::firmware
