#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cartwright::test {

/// Reads ULog as its public description asks of a reader, and knows nothing of the writer: formats are taken
/// from the file, an unfinished last message is left out.
struct UlogFile {
  struct Topic {
    std::vector<std::string> fields;
    std::vector<std::uint64_t> timestamps_us;
    std::vector<std::vector<double>> rows;
  };
  struct Dropout {
    std::size_t ticks_before;
    unsigned milliseconds;
  };

  bool valid = true;
  std::uint64_t start_us = 0;
  std::string first_types;
  std::map<std::string, std::string> info;
  std::map<std::string, float> parameters;
  std::map<std::string, Topic> topics;
  std::vector<Dropout> dropouts;
  std::vector<std::string> messages;

  explicit UlogFile(std::string_view bytes) {
    valid = bytes.size() >= 16 && bytes.starts_with(std::string_view("ULog\x01\x12\x35\x01", 8));
    if (!valid) return;
    start_us = take<std::uint64_t>(bytes, 8);
    bytes.remove_prefix(16);
    while (bytes.size() >= 3) {
      const auto size = take<std::uint16_t>(bytes, 0);
      const char type = bytes[2];
      bytes.remove_prefix(3);
      if (bytes.size() < size) return;
      if (first_types.size() < 1) first_types += type;
      message(type, bytes.substr(0, size));
      bytes.remove_prefix(size);
    }
  }

 private:
  template <typename Value>
  static Value take(std::string_view bytes, std::size_t at) {
    Value value{};
    if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  }

  void message(char type, std::string_view payload) {
    if (type == 'F') return format(payload);
    if (type == 'I' || type == 'P') {
      const std::size_t key_size = static_cast<unsigned char>(payload[0]);
      const std::string_view key = payload.substr(1, key_size);
      const std::string name(key.substr(key.find(' ') + 1));
      if (type == 'P') {
        valid = valid && key.starts_with("float ");
        parameters[name] = take<float>(payload, 1 + key_size);
      } else {
        info[name] = std::string(payload.substr(1 + key_size));
      }
    }
    if (type == 'A') topic_of_[take<std::uint16_t>(payload, 1)] = std::string(payload.substr(3));
    if (type == 'D') data(payload);
    if (type == 'O') dropouts.push_back({topics["tick"].rows.size(), take<std::uint16_t>(payload, 0)});
    if (type == 'L') messages.emplace_back(payload.substr(9));
  }

  void format(std::string_view text) {
    const auto colon = text.find(':');
    Topic& topic = topics[std::string(text.substr(0, colon))];
    text.remove_prefix(colon + 1);
    while (!text.empty()) {
      const std::string_view field = text.substr(0, text.find(';'));
      topic.fields.emplace_back(field);
      text.remove_prefix(field.size() + 1);
    }
    valid = valid && topic.fields.front() == "uint64_t timestamp";
  }

  void data(std::string_view payload) {
    const auto subscription = take<std::uint16_t>(payload, 0);
    valid = valid && topic_of_.contains(subscription);
    Topic& topic = topics[topic_of_[subscription]];
    valid = valid && payload.size() == 2 + 8 * topic.fields.size();
    topic.timestamps_us.push_back(take<std::uint64_t>(payload, 2));
    std::vector<double> row;
    for (std::size_t i = 1; i < topic.fields.size(); ++i) row.push_back(take<double>(payload, 2 + 8 * i));
    topic.rows.push_back(std::move(row));
  }

  std::map<std::uint16_t, std::string> topic_of_;
};

}  // namespace cartwright::test
