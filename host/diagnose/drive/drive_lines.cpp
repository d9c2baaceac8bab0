#include "host/diagnose/drive/drive_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/diagnose/search/explain.hpp"
#include "host/parallel.hpp"
#include "host/statistics/autocorrelation.hpp"

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kFewestWindows = 60;
constexpr double kStepsPerLobe = 5;      // lobes of a spectrum over the way are 1/travel wide
constexpr double kLeastRepeats = 2;      // of a period in the way
constexpr double kWindowsPerPeriod = 4;  // the shortest period has
constexpr double kLeastCounts = 40;      // of the encoder in a period
constexpr std::size_t kMostFrequencies = 1000;
constexpr double kLeastDistance = 2;   // of two lines, in lobes
constexpr std::size_t kMostLines = 8;  // those that no model holds leave the errors whiter
constexpr double kNumbersOfALine = 3;
constexpr int kPolishings = 3;

/// Columns that are the same but for rounding count as one: where the cart moves one way, direction and one.
Eigen::ColPivHouseholderQR<MatrixXd> factored(const MatrixXd& columns) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(columns.rows(), columns.cols());
  qr.setThreshold(1e-9);
  qr.compute(columns);
  return qr;
}

}  // namespace

MatrixXd orthonormal(const MatrixXd& columns) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr = factored(columns);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

DriveLines::DriveLines(const Session& session, unsigned threads)
    : session_(session), threads_(threads), windows_(drive_windows(session)) {
  if (windows_.size() < kFewestWindows) return;
  const auto n = static_cast<Index>(windows_.size());
  drive_.resize(n);
  base_.resize(n, 4);
  double low = 1e300, high = -1e300, way = 0;
  for (Index i = 0; i < n; ++i) {
    const DriveWindow& w = windows_[static_cast<std::size_t>(i)];
    drive_[i] = w.drive_V;
    base_.row(i) << (w.speed_m_per_s > 0 ? 1 : -1), 1, w.speed_m_per_s, w.acceleration_m_per_s2;
    low = std::min(low, w.position_m);
    high = std::max(high, w.position_m);
    const std::vector<double>& y_m = session.recordings[w.recording].y_m;
    way += std::abs(y_m[w.last] - y_m[w.first]);
  }
  both_ways_ = std::abs(base_.col(0).sum()) < static_cast<double>(n);
  travel_m_ = high - low;
  const double highest_per_m =
      std::min(1 / (kWindowsPerPeriod * way / static_cast<double>(n)),
               1 / (kLeastCounts * std::max(session.rig.encoder_resolution_m, 1e-12)));
  for (double f = kLeastRepeats / travel_m_; f < highest_per_m && grid_.size() < kMostFrequencies;
       f += 1 / (kStepsPerLobe * travel_m_))
    grid_.push_back(f);
  waves_.resize(grid_.size());
  parallel_for(grid_.size(), threads_, [&](std::size_t i) { waves_[i] = wave(grid_[i]); });
}

Rows DriveLines::all() const {
  Rows rows(windows_.size());
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

MatrixXd DriveLines::wave(double frequency_per_m) const {
  return waves_over(windows_, session_, frequency_per_m);
}

MatrixXd DriveLines::columns(const std::vector<double>& lines) const {
  MatrixXd x(base_.rows(), base_.cols() + 2 * static_cast<Index>(lines.size()));
  x.leftCols(base_.cols()) = base_;
  for (std::size_t i = 0; i < lines.size(); ++i)
    x.middleCols(base_.cols() + 2 * static_cast<Index>(i), 2) = wave(lines[i]);
  return x;
}

VectorXd DriveLines::solution(const Rows& rows, const MatrixXd& x) const {
  return factored(x(rows, Eigen::all)).solve(VectorXd(drive_(rows)));
}

VectorXd DriveLines::errors(const Rows& rows, const MatrixXd& x) const {
  const VectorXd u = drive_(rows);
  const MatrixXd q = orthonormal(x(rows, Eigen::all));
  return u - q * (q.transpose() * u);
}

std::vector<double> DriveLines::find(const Rows& rows) const {
  std::vector<double> lines;
  while (lines.size() < kMostLines) {
    const std::optional<double> next = next_line(rows, lines);
    if (!next) break;
    lines.push_back(*next);
    polish(rows, lines);
  }
  while (!lines.empty()) {
    const std::vector<double> gain = gains(rows, lines);
    const auto least = std::min_element(gain.begin(), gain.end());
    if (*least - kNumbersOfALine * kCostPerNumber >= kLeastGain) break;
    lines.erase(lines.begin() + (least - gain.begin()));
  }
  put_highest_first(rows, lines);
  return lines;
}

/// The line that explains most of what is left.
std::optional<double> DriveLines::next_line(const Rows& rows, const std::vector<double>& lines) const {
  const MatrixXd q = orthonormal(columns(lines)(rows, Eigen::all));
  const VectorXd u = drive_(rows), e = u - q * (q.transpose() * u);
  std::vector<double> explained(grid_.size());
  parallel_for(grid_.size(), threads_, [&](std::size_t i) {
    const bool apart = std::all_of(lines.begin(), lines.end(), [&](double line) {
      return std::abs(grid_[i] - line) * travel_m_ >= kLeastDistance;
    });
    if (!apart) return;
    MatrixXd pair = waves_[i](rows, Eigen::all);
    pair -= q * (q.transpose() * pair);
    const Eigen::Matrix2d h = pair.transpose() * pair;
    const Eigen::Vector2d g = pair.transpose() * e;
    explained[i] = g.dot(h.ldlt().solve(g));
  });
  const auto most = std::max_element(explained.begin(), explained.end());
  if (*most <= 0) return std::nullopt;
  return grid_[static_cast<std::size_t>(most - explained.begin())];
}

/// Each line to the top of the parabola through it and its neighbours, in turn.
void DriveLines::polish(const Rows& rows, std::vector<double>& lines) const {
  const double step = 0.5 / (kStepsPerLobe * travel_m_);
  MatrixXd x = columns(lines);
  for (int round = 0; round < kPolishings; ++round) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
      auto own = x.middleCols(base_.cols() + 2 * static_cast<Index>(i), 2);
      double left[3];
      for (int side : {-1, 0, 1}) {
        own = wave(lines[i] + side * step);
        left[side + 1] = errors(rows, x).squaredNorm();
      }
      const double bend = left[0] - 2 * left[1] + left[2];
      const double move = bend > 0 ? 0.5 * (left[0] - left[2]) / bend : 0;
      lines[i] += step * std::clamp(move, -1.0, 1.0);
      own = wave(lines[i]);
    }
  }
}

std::vector<double> DriveLines::gains(const Rows& rows, const std::vector<double>& lines) const {
  const VectorXd e = errors(rows, columns(lines));
  const double independent = static_cast<double>(e.size()) / errors_per_independent_one(e);
  std::vector<double> gain;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<double> others = lines;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    gain.push_back(0.5 * independent *
                   std::log(errors(rows, columns(others)).squaredNorm() / e.squaredNorm()));
  }
  return gain;
}

void DriveLines::put_highest_first(const Rows& rows, std::vector<double>& lines) const {
  const VectorXd x = solution(rows, columns(lines));
  std::vector<std::pair<double, double>> by_height;
  for (std::size_t i = 0; i < lines.size(); ++i)
    by_height.emplace_back(x.segment<2>(base_.cols() + 2 * static_cast<Index>(i)).norm(), lines[i]);
  std::sort(by_height.rbegin(), by_height.rend());
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = by_height[i].second;
}

}  // namespace cartwright
