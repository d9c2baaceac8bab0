#include "firmware/status.hpp"

#include <fmt/format.h>

namespace cartwright::firmware {

std::string sentence(const FaultReport& report) {
  const std::string_view words = wire::words(report.fault);
  switch (report.fault) {
    case wire::Fault::none:
      return {};
    case wire::Fault::travel_limit:
      return fmt::format("{} (at {:.4f} m, limit {:.4f} m)", words, report.value, report.bound);
    case wire::Fault::end_stop:
      return fmt::format("{} (at {:.4f} m)", words, report.value);
    case wire::Fault::encoder_jump:
      return fmt::format("{} ({:.1f} m/s, limit {:.1f} m/s)", words, report.value, report.bound);
    case wire::Fault::encoder_stuck:
      return fmt::format("{} ({:.1f} V for {:.2f} s)", words, report.value, report.bound);
    case wire::Fault::encoder_late:
      return fmt::format("{} ({:.1f} ms, limit {:.1f} ms)", words, 1e3 * report.value, 1e3 * report.bound);
    case wire::Fault::missed_ticks:
      return fmt::format("{} ({:.0f}, limit {:.0f})", words, report.value, report.bound);
    case wire::Fault::lost_host:
      return fmt::format("{} (limit {:.1f} s)", words, report.bound);
    default:
      return std::string(words);
  }
}

std::string sentence(const Status& status) {
  if (status.fault.fault == wire::Fault::none) return {};
  return fmt::format("{:.3f} s: {}", status.fault_time_s, sentence(status.fault));
}

std::string notice_sentence(const Status& status) {
  switch (status.notice) {
    case wire::Notice::none:
      return {};
    case wire::Notice::model_mismatch:
      return fmt::format("{:.1f} s: {} ({:.3g} m/s^2 unexplained, limit {:.3g})", status.notice_time_s,
                         wire::words(status.notice), status.innovation_m_per_s2,
                         status.innovation_limit_m_per_s2);
    default:
      return fmt::format("{:.1f} s: {}", status.notice_time_s, wire::words(status.notice));
  }
}

}  // namespace cartwright::firmware
