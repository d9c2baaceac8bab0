#include "host/diagnose/observe/noise.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace cartwright {

namespace {

/// The speed of a start is off by about this much, in reading errors a second: some centimetres a second.
constexpr double kStartSpeed_per_s = 1e4;
/// Least share of an error that corrects the position where readings are rounded. On simulated carts without
/// any noise but the rounding nothing gained more than 10 nats with it, with half of it up to 24.
constexpr double kLeastGainOfPosition = 0.1;
constexpr double kLeastDisturbance_per_s2 = 10, kMostDisturbance_per_s2 = 1e8;
/// After that long gains of the start are those of rest, near enough.
constexpr double kStart_s = 0.25;

}  // namespace

NoiseModel bounded(NoiseModel noise, const Rig& rig) {
  noise.correlation_time_s = std::clamp(noise.correlation_time_s, NoiseModel::kShortestCorrelation_s,
                                        NoiseModel::kLongestCorrelation_s);
  double least = kLeastDisturbance_per_s2;
  if (rig.encoder_resolution_m > 0) {
    const double power = std::pow(kLeastGainOfPosition, 4) / (8 * std::pow(rig.period_s(), 3));
    least = std::max(least, std::sqrt(power / noise.correlation_time_s));
  }
  noise.disturbance_per_reading_per_s2 =
      std::clamp(noise.disturbance_per_reading_per_s2, least, kMostDisturbance_per_s2);
  return noise;
}

ObserverGains observer_gains(const NoiseModel& noise, double period_s, double damping_per_s) {
  const double t = period_s;
  const double decay = std::exp(-t / noise.correlation_time_s);
  Eigen::Matrix3d f;
  f << 1, t - 0.5 * damping_per_s * t * t, 0.5 * t * t,  //
      0, 1 - damping_per_s * t, t,                       //
      0, 0, decay;
  const double ratio = noise.disturbance_per_reading_per_s2;
  const double q = ratio * ratio * (1 - decay * decay);
  Eigen::Matrix3d p = Eigen::Vector3d(1, kStartSpeed_per_s * kStartSpeed_per_s, ratio * ratio).asDiagonal();
  ObserverGains gains{{}, {}, noise, damping_per_s};
  const auto most_starting = static_cast<std::size_t>(kStart_s / t);
  Eigen::Vector3d gain = Eigen::Vector3d::Zero();
  double s = 1;
  constexpr int kMostIterations = 20000;
  for (int i = 0; i < kMostIterations; ++i) {
    p = f * p * f.transpose();
    p(2, 2) += q;
    s = p(0, 0) + 1;
    const Eigen::Vector3d next = p.col(0) / s;
    p -= next * p.row(0);
    p = 0.5 * (p + p.transpose().eval());
    const bool at_rest = (next - gain).norm() < 1e-9 * next.norm();
    gain = next;
    gains.settled = {gain[0], gain[1], gain[2], decay, s};
    if (at_rest) break;
    if (gains.starting.size() < most_starting) gains.starting.push_back(gains.settled);
  }
  return gains;
}

}  // namespace cartwright
