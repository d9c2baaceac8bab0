#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/result.hpp"

namespace cartwright {

/// Builds a ULog file (version 1) in memory, message by message, as the public description of the format has
/// it (docs.px4.io, "ULog File Format"): little endian, a header of 16 bytes, then messages of `uint16 size,
/// uint8 type, size bytes`. Definitions (info, parameter, format) come before the first subscription. A file
/// cut anywhere still reads up to the last whole message.
class UlogWriter {
 public:
  explicit UlogWriter(std::uint64_t start_us);

  void info(std::string_view key, std::string_view text);
  void info(std::string_view key, double value);
  /// The format allows parameters only as int32 and float.
  void parameter(std::string_view name, float value);
  /// A topic of doubles, after the timestamp that every topic has. Fails if it does not fit into a message.
  Result<void> format(std::string_view topic, const std::vector<std::string>& fields);

  /// Returns the number that `data` takes.
  std::uint16_t subscribe(std::string_view topic);
  void data(std::uint16_t subscription, std::uint64_t timestamp_us, const std::vector<double>& values);
  /// A loss of data; longer ones than the 65.535 s that one message holds become several.
  void dropout(double duration_s);
  void warning(std::uint64_t timestamp_us, std::string_view text);

  const std::string& bytes() const { return bytes_; }

 private:
  void message(char type, std::string_view payload);

  std::string bytes_;
  std::uint16_t subscriptions_ = 0;
};

}  // namespace cartwright
