#pragma once

#include <utility>
#include <vector>

#include "common/wire/codes.hpp"
#include "host/device/connection.hpp"
#include "host/device/register_block.hpp"

namespace cartwright::device {

using Setting = std::pair<wire::Id, double>;

/// The controller at the other end of a connection, by the register map of common/wire. One thread at a time.
///
/// The first `write` or `command` makes this client the one that commands, until it goes away: see
/// common/wire/README.md.
class Controller {
 public:
  /// Connects, and checks that what answers speaks this version of the map.
  static Answer<Controller> connect(const Address& address);

  /// Everything from `first` to `last`. Values that span requests (beyond 125 registers) may be of different
  /// ticks.
  Answer<RegisterBlock> read(wire::Id first, wire::Id last);
  Answer<RegisterBlock> read(wire::Id only) { return read(only, only); }

  /// Checks every value against its range, then writes them, neighbours together. Nothing is written if one
  /// is wrong.
  Answer<void> write(const std::vector<Setting>& settings);

  /// Asks, and waits for the answer. A refusal is a Trouble with the controller's own words.
  Answer<void> command(wire::Command command, std::uint16_t argument = 0);

  /// `words` registers of the log's window.
  Answer<std::vector<std::uint16_t>> read_window(std::size_t words);

  const Address& address() const { return connection_.address(); }

 private:
  explicit Controller(Connection connection) : connection_(std::move(connection)) {}
  Answer<void> read_words(std::uint16_t address, std::span<std::uint16_t> into);

  Connection connection_;
};

}  // namespace cartwright::device
