#include "host/session/rate.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/session/segments.hpp"

namespace cartwright {

bool same_rate(double one_hz, double other_hz) {
  constexpr double kTolerance = 0.1;
  return std::abs(one_hz / other_hz - 1) <= kTolerance;
}

Result<void> check_rate(const Recording& recording, const Rig& rig, double most_error,
                        const std::string& source) {
  const double step_s = median_period_s(recording.t_s);
  if (std::abs(step_s * rig.sample_rate_hz - 1) <= most_error) return {};
  return failure(
      fmt::format("{}: rows are {:.4g} ms apart, but session.toml says sample_rate_hz = {:.6g}; {:.4g} would "
                  "be right",
                  source, 1e3 * step_s, rig.sample_rate_hz, 1 / step_s));
}

}  // namespace cartwright
