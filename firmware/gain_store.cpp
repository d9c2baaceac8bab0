#include "firmware/gain_store.hpp"

#include <fmt/format.h>

#include <sstream>

#include "common/files/files.hpp"
#include "common/wire/codec.hpp"

namespace cartwright::firmware {
namespace {

std::uint32_t checksum(std::string_view text) {
  return wire::crc32(
      std::span<const std::uint8_t>(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::string line_of(int number, const GainSlot& slot) {
  const std::string body = fmt::format(
      "slot {} generation {} kp_V_per_m {} kd_V_s_per_m {} derivative_filter_hz {} on_measurement {} "
      "ki_V_per_m_s {}",
      number, slot.generation, slot.gains.pd.kp_V_per_m, slot.gains.pd.kd_V_s_per_m,
      slot.gains.pd.derivative_filter_hz, slot.gains.pd.derivative_on_measurement ? 1 : 0,
      slot.gains.ki_V_per_m_s);
  return fmt::format("{} crc {:08x}\n", body, checksum(body));
}

struct Line {
  int number = 0;
  GainSlot slot;
};

std::optional<Line> parse(const std::string& text) {
  const auto tail = text.rfind(" crc ");
  if (tail == std::string::npos) return std::nullopt;
  const std::string body = text.substr(0, tail);
  if (fmt::format("{:08x}", checksum(body)) != text.substr(tail + 5)) return std::nullopt;
  std::istringstream words(body);
  std::string word;
  Line line;
  int on_measurement = 0;
  words >> word >> line.number >> word >> line.slot.generation >> word >> line.slot.gains.pd.kp_V_per_m >>
      word >> line.slot.gains.pd.kd_V_s_per_m >> word >> line.slot.gains.pd.derivative_filter_hz >> word >>
      on_measurement;
  line.slot.gains.pd.derivative_on_measurement = on_measurement != 0;
  const bool whole = !words.fail();
  // A file from before there was an integral part ends here.
  if (whole && words >> word && !(words >> line.slot.gains.ki_V_per_m_s)) return std::nullopt;
  if (!whole || line.number < 1 || line.number > 2 || !within_bounds(line.slot.gains)) return std::nullopt;
  return line;
}

}  // namespace

bool within_bounds(const PidGains& gains) {
  const auto inside = [](wire::Id id, double value) {
    const wire::Register& r = wire::info(id);
    return value >= r.least && value <= r.most;
  };
  return inside(wire::Id::staged_kp_V_per_m, gains.pd.kp_V_per_m) &&
         inside(wire::Id::staged_kd_V_s_per_m, gains.pd.kd_V_s_per_m) &&
         inside(wire::Id::staged_filter_hz, gains.pd.derivative_filter_hz) &&
         inside(wire::Id::staged_ki_V_per_m_s, gains.ki_V_per_m_s);
}

Result<GainStore> GainStore::open(const std::filesystem::path& file) {
  GainStore store;
  store.file_ = file;
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return store;
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  std::istringstream lines(*text);
  int number_of_line = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number_of_line;
    if (const auto parsed = parse(line)) {
      store.slots_[static_cast<std::size_t>(parsed->number - 1)] = parsed->slot;
    } else {
      store.doubts_.push_back(
          fmt::format("{}:{}: checksum or bounds are wrong, these gains are not used; cartwright device "
                      "gains flash writes them anew",
                      file.string(), number_of_line));
    }
  }
  for (const int number : {1, 2}) {
    const auto& slot = store.slot(number);
    if (slot && (store.active_ == 0 || slot->generation > store.slot(store.active_)->generation)) {
      store.active_ = number;
    }
  }
  return store;
}

Result<void> GainStore::store(const PidGains& gains) {
  if (!within_bounds(gains)) return failure("gains are out of bounds");
  std::uint32_t newest = 0;
  for (const auto& slot : slots_) newest = slot ? std::max(newest, slot->generation) : newest;
  const int number = active_ == 1 ? 2 : 1;
  auto slots = slots_;
  slots[static_cast<std::size_t>(number - 1)] = GainSlot{newest + 1, gains};
  std::string text;
  for (const int each : {1, 2}) {
    const auto& slot = slots[static_cast<std::size_t>(each - 1)];
    if (slot) text += line_of(each, *slot);
  }
  const auto written = write_file(file_, text);
  if (!written) return written;
  slots_ = slots;
  active_ = number;
  return {};
}

Result<void> GainStore::activate(int number) {
  if (number < 1 || number > 2 || !slot(number))
    return failure(fmt::format("slot {} holds no valid gains", number));
  active_ = number;
  return {};
}

}  // namespace cartwright::firmware
