#include "host/relay/relay_identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

/// Friction level and coefficient are told apart where each is known to this part of the whole friction.
constexpr double kSeparable = 0.15;

Estimate estimate_of(double value, double variance, double t) {
  return Estimate::within(value, t * std::sqrt(std::max(0.0, variance)));
}

std::vector<RelayFeature> features(const std::vector<RelayReport::Entry>& entries) {
  std::vector<RelayFeature> out;
  for (const auto& e : entries) {
    if (!e.cycle) continue;
    out.push_back({e.gains.h1_V, e.gains.h2_V, e.cycle->sine.amplitude.value,
                   2 * std::numbers::pi * e.cycle->sine.frequency_hz.value});
  }
  return out;
}

void describing_functions(RelayReport& report) {
  const auto experiments = features(report.recordings);
  if (const auto corrected = corrected_describing_function(experiments)) report.corrected = *corrected;
  if (const auto published = published_describing_function(experiments)) {
    report.published = *published;
  } else if (experiments.size() == 2) {
    if (const auto printed = published_equation_17(experiments[0], experiments[1]))
      report.published = *printed;
  }
}

/// value/beta with its variance by the delta method.
Estimate over_gain(const RelayMatch& m, Eigen::Index k, double t) {
  Eigen::Vector4d by = Eigen::Vector4d::Zero();
  by(k) = 1 / m.values(0);
  by(0) = -m.values(k) / (m.values(0) * m.values(0));
  return estimate_of(m.values(k) / m.values(0), by.dot(m.covariance * by), t);
}

void fill_values(const RelayMatch& m, RelayReport& report) {
  const double t = student_t(0.95, m.degrees);
  const auto estimate = [&](RelayValue value) {
    const auto k = static_cast<Eigen::Index>(value);
    return estimate_of(m.values(k), m.covariance(k, k), t);
  };
  const Estimate gain = estimate(RelayValue::voltage_gain);
  const Estimate viscous = estimate(RelayValue::viscous);
  Estimate coulomb = estimate(RelayValue::coulomb);
  coulomb.low = std::max(0.0, coulomb.low);
  const double whole = m.values(1) * m.mean_speed_m_per_s + m.values(2);
  const bool separable = (coulomb.high - coulomb.low) / 2 < kSeparable * whole &&
                         (viscous.high - viscous.low) / 2 * m.mean_speed_m_per_s < kSeparable * whole;
  report.parameters.push_back({"voltage_gain_m_per_s2_V", gain});
  if (separable) {
    report.parameters.push_back({"viscous_friction.coefficient_per_s", viscous});
    report.parameters.push_back({"coulomb_friction.level_m_per_s2", coulomb});
  }
  report.parameters.push_back({"constant_force.acceleration_m_per_s2", estimate(RelayValue::constant)});
  const double beta = m.values(0);
  report.combinations.push_back({"Tp/Kp", estimate_of(1 / beta, m.covariance(0, 0) / std::pow(beta, 4), t)});
  if (separable) {
    report.combinations.push_back({"f1", over_gain(m, 2, t)});
    report.combinations.back().estimate.low = std::max(0.0, report.combinations.back().estimate.low);
    report.combinations.push_back({"1/Kp+f2", over_gain(m, 1, t)});
    report.not_separable.push_back(
        {{"Kp", "f2"}, "1/Kp + f2", over_gain(m, 1, t), "viscous friction and back-EMF are one term in v"});
  } else {
    // The best-known mixture c + k F: k takes the correlation out.
    const double k = -m.covariance(1, 2) / m.covariance(2, 2);
    const double variance = m.covariance(1, 1) + 2 * k * m.covariance(1, 2) + k * k * m.covariance(2, 2);
    report.not_separable.push_back(
        {{"viscous_friction.coefficient_per_s", "coulomb_friction.level_m_per_s2"},
         fmt::format("viscous_friction.coefficient_per_s + {:.6g} coulomb_friction.level_m_per_s2", k),
         estimate_of(m.values(1) + k * m.values(2), variance, t),
         "the recordings hold too narrow a range of speeds; another relay amplitude tells them apart"});
    report.not_separable.push_back({{"Kp", "f2"},
                                    "1/Kp + f2",
                                    Estimate{std::nan("")},
                                    "viscous friction and back-EMF are one term in v"});
  }
}

}  // namespace

Result<RelayReport> identify_from_relay(const Session& session) {
  RelayReport report;
  std::vector<RelayRecording> usable;
  for (const Recording& recording : session.recordings) {
    const auto* gains = std::get_if<DualRelayGains>(&recording.controller);
    if (gains == nullptr) continue;
    RelayReport::Entry entry;
    entry.file = recording.file;
    entry.gains = *gains;
    auto cycle = find_limit_cycle(recording, session.rig);
    if (cycle) {
      entry.cycle = *std::move(cycle);
      usable.push_back({&recording, *entry.cycle});
    } else {
      entry.refused = cycle.error().message;
    }
    report.recordings.push_back(std::move(entry));
  }
  if (report.recordings.empty())
    return failure("no dual-relay recording in the session (controller type dual_relay)");
  if (usable.empty()) {
    std::string reasons;
    for (const auto& entry : report.recordings) {
      reasons += fmt::format("{}{}: {}", reasons.empty() ? "" : "; ", entry.file, entry.refused);
    }
    return failure("no usable relay recording: " + reasons);
  }
  describing_functions(report);
  const auto match = match_limit_cycles(usable);
  if (!match) return tl::unexpected(match.error());
  fill_values(*match, report);
  std::size_t used = 0;
  for (auto& entry : report.recordings) {
    if (!entry.cycle) continue;
    entry.rms_m = match->rms_m[used];
    entry.predicted_m = match->predicted_m[used++];
  }
  return report;
}

}  // namespace cartwright
