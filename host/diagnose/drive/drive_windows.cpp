#include "host/diagnose/drive/drive_windows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cartwright {
namespace {

constexpr double kWindow_s = 0.05;
constexpr double kAroundAnEdge_s = 0.0125;
constexpr double kGapInPeriods = 3;
constexpr std::size_t kMostRowsLookedAt = 8;  // of a window, which is a quarter of a wave at most
constexpr double kNearlyStands = 0.1;         // of the usual speed
constexpr double kThrown = 3;                 // times the usual speed

bool has_gap(const Recording& r, std::size_t first, std::size_t last, double period_s) {
  for (std::size_t k = first; k < last; ++k) {
    if (r.t_s[k + 1] - r.t_s[k] > kGapInPeriods * period_s) return true;
  }
  return false;
}

/// Around one row.
double speed_at(const Recording& r, std::size_t row) {
  const auto at = [&](double t_s) {
    const auto found = std::lower_bound(r.t_s.begin(), r.t_s.end(), t_s);
    return std::min(static_cast<std::size_t>(found - r.t_s.begin()), r.size() - 1);
  };
  const std::size_t before = at(r.t_s[row] - kAroundAnEdge_s), after = at(r.t_s[row] + kAroundAnEdge_s);
  return (r.y_m[after] - r.y_m[before]) / (r.t_s[after] - r.t_s[before]);
}

DriveWindow means(const Recording& r, std::size_t recording, std::size_t first, std::size_t last) {
  DriveWindow window{recording, first, last};
  for (std::size_t k = first; k < last; ++k) {
    const double share = (r.t_s[k + 1] - r.t_s[k]) / (r.t_s[last] - r.t_s[first]);
    window.drive_V += share * r.u_V[k];
    window.position_m += share * r.y_m[k];
  }
  const double length_s = r.t_s[last] - r.t_s[first];
  window.speed_m_per_s = (r.y_m[last] - r.y_m[first]) / length_s;
  window.acceleration_m_per_s2 = (speed_at(r, last) - speed_at(r, first)) / length_s;
  return window;
}

std::vector<DriveWindow> all_windows(const Session& session) {
  std::vector<DriveWindow> windows;
  for (std::size_t n = 0; n < session.recordings.size(); ++n) {
    const Recording& r = session.recordings[n];
    for (std::size_t first = 0;;) {
      const auto end = std::lower_bound(r.t_s.begin(), r.t_s.end(), r.t_s[first] + kWindow_s);
      if (end == r.t_s.end()) break;
      const auto last = static_cast<std::size_t>(end - r.t_s.begin());
      if (!has_gap(r, first, last, session.rig.period_s())) windows.push_back(means(r, n, first, last));
      first = last;
    }
  }
  return windows;
}

double usual_speed(const std::vector<DriveWindow>& windows) {
  std::vector<double> speeds;
  for (const DriveWindow& w : windows) speeds.push_back(std::abs(w.speed_m_per_s));
  const auto middle = speeds.begin() + static_cast<std::ptrdiff_t>(speeds.size() / 2);
  std::nth_element(speeds.begin(), middle, speeds.end());
  return *middle;
}

}  // namespace

std::vector<DriveWindow> drive_windows(const Session& session) {
  const std::vector<DriveWindow> all = all_windows(session);
  if (all.empty()) return {};
  std::vector<double> usual;  // of each recording: the speed may be another in each
  for (std::size_t n = 0; n < session.recordings.size(); ++n) {
    std::vector<DriveWindow> own;
    std::copy_if(all.begin(), all.end(), std::back_inserter(own),
                 [&](const DriveWindow& w) { return w.recording == n; });
    usual.push_back(own.empty() ? 0 : usual_speed(own));
  }
  const auto keeps_speed = [&](const DriveWindow& w) {
    const double speed = std::abs(w.speed_m_per_s), own = usual[w.recording];
    return speed > kNearlyStands * own && speed < kThrown * own;
  };
  const auto beside = [&](const DriveWindow& a, const DriveWindow& b) {
    return a.recording == b.recording && a.last == b.first && keeps_speed(a) && keeps_speed(b);
  };
  std::vector<DriveWindow> kept;
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    if (beside(all[i - 1], all[i]) && beside(all[i], all[i + 1])) kept.push_back(all[i]);
  }
  return kept;
}

Eigen::MatrixX2d waves_over(const std::vector<DriveWindow>& windows, const Session& session,
                            double frequency_per_m) {
  Eigen::MatrixX2d waves(static_cast<Eigen::Index>(windows.size()), 2);
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const DriveWindow& w = windows[i];
    const std::vector<double>& y_m = session.recordings[w.recording].y_m;
    double sine = 0, cosine = 0, rows = 0;
    const std::size_t stride = (w.last - w.first + kMostRowsLookedAt - 1) / kMostRowsLookedAt;
    for (std::size_t k = w.first + stride / 2; k < w.last; k += stride, ++rows) {
      const double phase = 2 * std::numbers::pi * frequency_per_m * y_m[k];
      sine += std::sin(phase);
      cosine += std::cos(phase);
    }
    waves.row(static_cast<Eigen::Index>(i)) << sine / rows, cosine / rows;
  }
  return waves;
}

}  // namespace cartwright
