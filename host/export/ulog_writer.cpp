#include "host/export/ulog_writer.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

namespace cartwright {
namespace {

static_assert(std::endian::native == std::endian::little,
              "ULog is little endian, and values are copied as they are");

constexpr std::size_t kLongestMessage = std::numeric_limits<std::uint16_t>::max();

template <typename Value>
void append(std::string& bytes, Value value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// `uint8 length, "type name", value`: what info and parameter messages hold.
std::string keyed(std::string_view type, std::string_view name, std::string_view value) {
  const std::string key =
      fmt::format("{} {}", type, name).substr(0, std::numeric_limits<std::uint8_t>::max());
  std::string payload;
  append(payload, static_cast<std::uint8_t>(key.size()));
  payload += key;
  payload += value;
  return payload;
}

}  // namespace

UlogWriter::UlogWriter(std::uint64_t start_us) {
  constexpr std::string_view kMagicAndVersion("\x55\x4c\x6f\x67\x01\x12\x35\x01", 8);
  bytes_ = kMagicAndVersion;
  append(bytes_, start_us);
  // Flag bits must come first: 8 compatible flags, 8 incompatible flags, 3 offsets of appended data; all
  // unused.
  message('B', std::string(40, '\0'));
}

void UlogWriter::message(char type, std::string_view payload) {
  append(bytes_, static_cast<std::uint16_t>(payload.size()));
  bytes_ += type;
  bytes_ += payload;
}

void UlogWriter::info(std::string_view key, std::string_view text) {
  constexpr std::size_t kLongestText =
      1024;  // far above any name here; keeps the message within its 16-bit size
  text = text.substr(0, kLongestText);
  message('I', keyed(fmt::format("char[{}]", text.size()), key, text));
}

void UlogWriter::info(std::string_view key, double value) {
  std::string raw;
  append(raw, value);
  message('I', keyed("double", key, raw));
}

void UlogWriter::parameter(std::string_view name, float value) {
  std::string raw;
  append(raw, value);
  message('P', keyed("float", name, raw));
}

Result<void> UlogWriter::format(std::string_view topic, const std::vector<std::string>& fields) {
  std::string text = fmt::format("{}:uint64_t timestamp;", topic);
  for (const std::string& field : fields) text += fmt::format("double {};", field);
  const std::size_t data_bytes =
      sizeof(std::uint16_t) + sizeof(std::uint64_t) + sizeof(double) * fields.size();
  if (text.size() > kLongestMessage || data_bytes > kLongestMessage) {
    return failure(fmt::format("{} columns do not fit into a ULog message of {} bytes; export to mat",
                               fields.size(), kLongestMessage));
  }
  message('F', text);
  return {};
}

std::uint16_t UlogWriter::subscribe(std::string_view topic) {
  std::string payload(1, '\0');  // multi_id: the first and only instance
  append(payload, subscriptions_);
  payload += topic;
  message('A', payload);
  return subscriptions_++;
}

void UlogWriter::data(std::uint16_t subscription, std::uint64_t timestamp_us,
                      const std::vector<double>& values) {
  append(bytes_, static_cast<std::uint16_t>(sizeof subscription + sizeof timestamp_us +
                                            sizeof(double) * values.size()));
  bytes_ += 'D';
  append(bytes_, subscription);
  append(bytes_, timestamp_us);
  bytes_.append(reinterpret_cast<const char*>(values.data()), sizeof(double) * values.size());
}

void UlogWriter::dropout(double duration_s) {
  constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
  for (double left_ms = std::max(1.0, std::round(duration_s * 1e3)); left_ms > 0; left_ms -= kMost) {
    std::string payload;
    append(payload, static_cast<std::uint16_t>(std::min(left_ms, kMost)));
    message('O', payload);
  }
}

void UlogWriter::warning(std::uint64_t timestamp_us, std::string_view text) {
  std::string payload = "4";  // the level of a warning in the Linux kernel
  append(payload, timestamp_us);
  payload += text;
  message('L', payload);
}

}  // namespace cartwright
