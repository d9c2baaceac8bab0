#include "common/identify/model_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

constexpr double kRise = 2, kShareOfDrive = 0.02, kWrongFromTheStart = 0.1, kBack = 0.7;
/// Fewer windows than these, two seconds of movement, are no judgement.
constexpr std::uint32_t kFewestWindows = 80;

}  // namespace

void ModelMonitor::add(const WeakWindow& window) noexcept {
  windows_ = std::min(windows_ + 1, 2 * kWindows);
  const double share = 1.0 / std::min(windows_, kWindows);
  const double error = window.response_m_per_s2 - window.modelled_m_per_s2;
  error_square_ += share * (error * error - error_square_);
  drive_square_ += share * (window.drive_m_per_s2 * window.drive_m_per_s2 - drive_square_);
  innovation_m_per_s2_ = std::sqrt(error_square_);
  if (windows_ < kFewestWindows) return;
  const double drive = std::sqrt(drive_square_);
  if (!learned() && windows_ >= kWindows) {
    learned_m_per_s2_ = std::max(innovation_m_per_s2_, kShareOfDrive / kRise * drive);
  }
  limit_m_per_s2_ = kWrongFromTheStart * drive;
  if (learned()) {
    limit_m_per_s2_ = std::min(limit_m_per_s2_, std::max(kRise * learned_m_per_s2_, kShareOfDrive * drive));
  }
  if (innovation_m_per_s2_ > limit_m_per_s2_) raised_ = true;
  if (innovation_m_per_s2_ < kBack * limit_m_per_s2_) raised_ = false;
}

}  // namespace cartwright
