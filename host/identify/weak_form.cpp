#include "host/identify/weak_form.hpp"

#include <algorithm>
#include <cmath>

namespace cartwright {

std::vector<Window> place_windows(const std::vector<double>& t_s, const std::vector<Segment>& stretches,
                                  const WeakFormOptions& options) {
  std::vector<Window> out;
  for (const Segment& stretch : stretches) {
    if (stretch.size() < 8) continue;
    const double start_s = t_s[stretch.first], length_s = t_s[stretch.last - 1] - start_s;
    if (length_s < options.least_share * options.window_s) continue;
    const double window_s = std::min(options.window_s, length_s);
    const double room_s = length_s - window_s;
    const auto count = 1 + static_cast<std::size_t>(std::ceil(room_s / (options.hop * window_s) - 1e-9));
    std::size_t first = stretch.first, last = stretch.first;
    for (std::size_t i = 0; i < count; ++i) {
      const double share = count == 1 ? 0 : static_cast<double>(i) / static_cast<double>(count - 1);
      Window window;
      window.bump.half_s = 0.5 * window_s;
      window.bump.centre_s = start_s + share * room_s + 0.5 * window_s;
      while (first + 1 < stretch.last && t_s[first + 1] <= window.bump.centre_s - window.bump.half_s) ++first;
      while (last < stretch.last && t_s[last] < window.bump.centre_s + window.bump.half_s) ++last;
      window.first = first;
      window.last = std::min(last + 1, stretch.last);
      out.push_back(window);
    }
  }
  return out;
}

Eigen::VectorXd weak_acceleration(const std::vector<Window>& windows, const std::vector<double>& t_s,
                                  const std::vector<double>& y_m) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(windows.size()));
  Eigen::Index at = 0;
  for (const Window& window : windows) {
    double sum = 0, before = window.bump.value(t_s[window.first]);
    for (std::size_t row = window.first; row + 1 < window.last; ++row) {
      const double now = window.bump.value(t_s[row + 1]);
      sum -= (y_m[row + 1] - y_m[row]) / (t_s[row + 1] - t_s[row]) * (now - before);
      before = now;
    }
    out[at++] = sum / window.bump.area_s();
  }
  return out;
}

Eigen::MatrixXd weak_means(const std::vector<Window>& windows, const std::vector<double>& t_s,
                           const Eigen::MatrixXd& interval_means) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(windows.size()), interval_means.cols());
  Eigen::VectorXd weights;
  Eigen::Index at = 0;
  for (const Window& window : windows) {
    const auto intervals = static_cast<Eigen::Index>(window.last - window.first) - 1;
    weights.resize(intervals);
    double before = window.bump.value(t_s[window.first]);
    for (Eigen::Index k = 0; k < intervals; ++k) {
      const std::size_t row = window.first + static_cast<std::size_t>(k);
      const double now = window.bump.value(t_s[row + 1]);
      weights[k] = 0.5 * (before + now) * (t_s[row + 1] - t_s[row]) / window.bump.area_s();
      before = now;
    }
    out.row(at++).noalias() =
        weights.transpose() * interval_means.middleRows(static_cast<Eigen::Index>(window.first), intervals);
  }
  return out;
}

}  // namespace cartwright
