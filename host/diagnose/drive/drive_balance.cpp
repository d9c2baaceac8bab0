#include "host/diagnose/drive/drive_balance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/model/vocabulary.hpp"
#include "host/diagnose/drive/drive_lines.hpp"
#include "host/statistics/autocorrelation.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kQuarters = 4;
constexpr double kStepsPerLobeOfTime = 3;
constexpr double kHighest_Hz = 5;  // four windows in a period, as over the way

std::vector<double> those_a_model_holds(std::vector<double> lines) {
  if (lines.size() > kCoggingWaves.size()) lines.resize(kCoggingWaves.size());
  return lines;
}

/// Of every line its slopes by sine, cosine and frequency give the interval.
std::vector<DriveLine> estimates(const DriveLines& drive, const std::vector<double>& lines) {
  const MatrixXd x = drive.columns(lines);
  const VectorXd b = drive.solution(drive.all(), x), e = drive.drive_V() - x * b;
  const Index first = drive.base().cols(), m = static_cast<Index>(lines.size());
  MatrixXd slopes(x.rows(), x.cols() + m);
  slopes.leftCols(x.cols()) = x;
  const double step = 0.01 / drive.travel_m();
  for (Index i = 0; i < m; ++i) {
    const double line = lines[static_cast<std::size_t>(i)];
    slopes.col(x.cols() + i) =
        (drive.wave(line + step) - drive.wave(line - step)) * b.segment<2>(first + 2 * i) / (2 * step);
  }
  const double variance = e.squaredNorm() / static_cast<double>(e.size()) * errors_per_independent_one(e);
  const VectorXd scale = slopes.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const MatrixXd scaled = slopes * scale.asDiagonal();
  const MatrixXd inverse = (scaled.transpose() * scaled).completeOrthogonalDecomposition().pseudoInverse();
  const MatrixXd covariance = variance * (scale.asDiagonal() * inverse * scale.asDiagonal());
  const auto around = [](double value, double variance_of_it) {
    return Estimate::within(value, normal(0.95) * std::sqrt(std::max(variance_of_it, 0.0)));
  };
  const std::vector<double> gain = drive.gains(drive.all(), lines);
  std::vector<DriveLine> out;
  for (Index i = 0; i < m; ++i) {
    const Index at = first + 2 * i, by_frequency = x.cols() + i;
    const double height = b.segment<2>(at).norm(), period = 1 / lines[static_cast<std::size_t>(i)];
    const Eigen::Vector2d along = b.segment<2>(at) / height, across(-along[1], along[0]);
    const Eigen::Matrix2d of_line = covariance.block<2, 2>(at, at);
    out.push_back({around(height, along.dot(of_line * along)),
                   around(period, std::pow(period, 4) * covariance(by_frequency, by_frequency)),
                   around(std::atan2(along[1], along[0]), across.dot(of_line * across) / (height * height)),
                   gain[static_cast<std::size_t>(i)]});
  }
  return out;
}

void leave_out_quarters(const DriveLines& drive, DriveBalance& out) {
  const std::vector<DriveWindow>& windows = drive.windows();
  const double low_m = std::min_element(windows.begin(), windows.end(), [](const auto& a, const auto& b) {
                         return a.position_m < b.position_m;
                       })->position_m;
  double missing = 0, left = 0;
  for (int quarter = 0; quarter < kQuarters; ++quarter) {
    Rows seen, unseen;
    for (std::size_t i = 0; i < windows.size(); ++i) {
      const int place = static_cast<int>(kQuarters * (windows[i].position_m - low_m) / drive.travel_m());
      (std::min(place, kQuarters - 1) == quarter ? unseen : seen).push_back(static_cast<Index>(i));
    }
    const auto error_of = [&](const MatrixXd& x) {
      const VectorXd u = drive.drive_V()(unseen);
      return (u - x(unseen, Eigen::all) * drive.solution(seen, x)).squaredNorm();
    };
    missing += error_of(drive.base());
    left += error_of(drive.columns(those_a_model_holds(drive.find(seen))));
  }
  const double n = static_cast<double>(windows.size());
  out.unseen_missing_V = std::sqrt(missing / n);
  out.unseen_left_V = std::sqrt(left / n);
}

/// Squared error beside the base and the best line over time.
double left_by_time(const DriveLines& drive, const Session& session) {
  const MatrixXd q = orthonormal(drive.base());
  const VectorXd e = drive.drive_V() - q * (q.transpose() * drive.drive_V());
  double longest_s = 0;
  for (const Recording& r : session.recordings) longest_s = std::max(longest_s, r.t_s.back() - r.t_s.front());
  const std::vector<DriveWindow>& windows = drive.windows();
  const auto middle_s = [&](const DriveWindow& w) {
    const std::vector<double>& t_s = session.recordings[w.recording].t_s;
    return 0.5 * (t_s[w.first] + t_s[w.last]);
  };
  double most = 0;
  const double step_Hz = 1 / (kStepsPerLobeOfTime * longest_s);
  for (double f_Hz = 2 / longest_s; f_Hz < kHighest_Hz; f_Hz += step_Hz) {
    const double turn = 2 * std::numbers::pi * f_Hz;
    MatrixXd x = MatrixXd::Zero(e.size(), 2 * static_cast<Index>(session.recordings.size()));
    for (Index k = 0; k < e.size(); ++k) {
      const DriveWindow& w = windows[static_cast<std::size_t>(k)];
      x.block<1, 2>(k, 2 * static_cast<Index>(w.recording)) << std::sin(turn * middle_s(w)),
          std::cos(turn * middle_s(w));
    }
    x -= q * (q.transpose() * x);
    most = std::max(most, (orthonormal(x).transpose() * e).squaredNorm());
  }
  return e.squaredNorm() - most;
}

}  // namespace

double DriveBalance::share_left() const {
  return unseen_missing_V > 0 ? std::pow(unseen_left_V / unseen_missing_V, 2) : 1;
}

std::optional<DriveBalance> drive_balance(const Session& session, unsigned threads) {
  const DriveLines drive(session, threads);
  if (!drive.enough()) return std::nullopt;
  const std::vector<double> lines = drive.find(drive.all());
  if (lines.empty()) return std::nullopt;
  DriveBalance out;
  out.lines = estimates(drive, lines);
  const std::vector<double> held = those_a_model_holds(lines);
  out.held = held.size();
  const MatrixXd x = drive.columns(held);
  const VectorXd b = drive.solution(drive.all(), x), predicted = x * b;
  const double n = static_cast<double>(drive.windows().size());
  out.missing_V = drive.errors(drive.all(), drive.base()).norm() / std::sqrt(n);
  out.left_V = (drive.drive_V() - predicted).norm() / std::sqrt(n);
  out.windows = drive.windows();
  out.predicted_V.assign(predicted.data(), predicted.data() + predicted.size());
  out.friction_V = b[0] + b[2] * drive.base().col(2).cwiseAbs().mean();
  if (!drive.both_ways()) out.friction_V += b[1] * drive.base()(0, 0);
  leave_out_quarters(drive, out);
  const VectorXd by_way = drive.errors(drive.all(), drive.columns({lines.front()}));
  const double independent = n / errors_per_independent_one(by_way);
  out.time_behind = 0.5 * independent * std::log(left_by_time(drive, session) / by_way.squaredNorm());
  return out;
}

}  // namespace cartwright
