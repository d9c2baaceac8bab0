#include "host/diagnose/judge/next_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/diagnose/judge/surrogate.hpp"
#include "host/parallel.hpp"

namespace cartwright {
namespace {

constexpr double kDuration_s = 8;
constexpr double kLeastChance = 0.5;
constexpr double kShareOfTravel = 0.8;  // of what the rig has, so that an overshoot stays inside

struct Proposal {
  std::string command;
  Recording recording;
};

/// A sum of lines spread evenly in the logarithm of frequency, of the given greatest value.
std::vector<double> multisine(const std::vector<double>& t_s, double low_hz, double high_hz, int lines,
                              double amplitude) {
  std::vector<double> sum(t_s.size(), 0.0);
  for (int i = 0; i < lines; ++i) {
    const double f = low_hz * std::pow(high_hz / low_hz, i / (lines - 1.0));
    const double phase = 2.4 * i * i;
    for (std::size_t k = 0; k < t_s.size(); ++k)
      sum[k] += std::sin(2 * std::numbers::pi * f * t_s[k] + phase);
  }
  double peak = 0;
  for (const double s : sum) peak = std::max(peak, std::abs(s));
  for (double& s : sum) s *= amplitude / peak;
  return sum;
}

/// What a rig can be asked to do, from gentle to hard.
std::vector<Proposal> menu(const Rig& rig, const SessionFacts& facts) {
  Recording blank;
  const auto rows = static_cast<std::size_t>(kDuration_s * rig.sample_rate_hz);
  for (std::size_t k = 0; k < rows; ++k) blank.t_s.push_back(static_cast<double>(k) * rig.period_s());
  blank.r_m.assign(rows, 0.0);
  blank.y_m = blank.u_V = blank.r_m;
  const double reach =
      kShareOfTravel * std::max(std::abs(facts.position_low_m), std::abs(facts.position_high_m));
  const double most_V = std::isfinite(rig.voltage_limit_V) ? rig.voltage_limit_V : facts.most_voltage_V;
  std::vector<Proposal> list;
  const auto add = [&](std::string command, const char* experiment, ControllerSpec controller, Recording r) {
    r.file = fmt::format("proposal_{}.csv", list.size() + 1);
    r.experiment = experiment;
    r.controller = controller;
    list.push_back({std::move(command), std::move(r)});
  };
  const PdGains soft{60, 0, 50, false}, firm{80, 2, 50, false}, hold{30, 1, 50, false};
  for (const double share : {0.3, 0.8}) {
    Recording r = blank;
    for (std::size_t k = 0; k < rows; ++k) r.r_m[k] = std::fmod(r.t_s[k], 2.0) < 1.0 ? share * reach : 0.0;
    add(fmt::format("step --amplitude-m {:.3g} --interval-s 1 --duration-s 8 --kp-V-per-m 60", share * reach),
        "step", soft, r);
  }
  for (const double share : {0.12, 0.25, 0.5}) {
    const double h1 = share * most_V, h2 = 0.75 * h1;
    add(fmt::format("relay --h1-V {:.3g} --h2-V {:.3g} --stop no --duration-s 8", h1, h2), "relay",
        DualRelayGains{h1, h2, 0}, blank);
  }
  for (const auto& [low, high, share] : {std::tuple{0.125, 1.0, 0.8}, {0.25, 4.0, 0.4}}) {
    Recording r = blank;
    r.r_m = multisine(r.t_s, low, high, 8, share * reach);
    add(fmt::format(
            "track --amplitude-m {:.3g} --low-hz {} --high-hz {} --lines 8 --duration-s 8 --kp-V-per-m 80 "
            "--kd-V-s-per-m 2",
            share * reach, low, high),
        "track", firm, r);
  }
  for (const double speed : {0.03, 0.15}) {
    Recording r = blank;
    const double half = 0.5 * reach, leg = 2 * half / speed;
    for (std::size_t k = 0; k < rows; ++k) {
      const double into = std::fmod(r.t_s[k], 2 * leg);
      r.r_m[k] = into < leg ? -half + speed * into : half - speed * (into - leg);
    }
    add(fmt::format(
            "sweep --amplitude-m {:.3g} --slowest-m-per-s {} --fastest-m-per-s {} --speeds 1 --kp-V-per-m 80 "
            "--kd-V-s-per-m 2",
            half, speed, speed),
        "sweep", firm, r);
  }
  for (const auto& [high, share] : {std::tuple{20.0, 0.25}, {60.0, 0.5}}) {
    Recording r = blank;
    r.d_V = multisine(r.t_s, 0.5, high, 20, share * most_V);
    add(fmt::format("dither --amplitude-V {:.3g} --low-hz 0.5 --high-hz {} --duration-s 8 --kp-V-per-m 30 "
                    "--kd-V-s-per-m 1",
                    share * most_V, high),
        "dither", hold, r);
  }
  return list;
}

/// The numbers of the effects of an explanation: what a new recording may move; the rest the session has
/// fixed.
std::vector<FreeParameter> of_its_effects(const Explanation& one) {
  std::vector<FreeParameter> free;
  for (const FreeParameter& p : one.fit.free) {
    const auto& term = info(p.id).term;
    if (term && one.has(*term)) free.push_back(p);
  }
  return free;
}

/// By how much `data`, made by `truth`, would speak against `rival`.
PairedDifference difference(const Session& data, const Explanation& truth, const Explanation& rival,
                            FitOptions options) {
  options.move_noise = false;
  options.most_rounds = 1;
  options.most_iterations = 4;
  const Fit right = fit(data, truth.fit.model, truth.fit.noise, {}, options);
  const Fit wrong = fit(data, rival.fit.model, rival.fit.noise, of_its_effects(rival), options);
  return {right.log_likelihood - wrong.log_likelihood, paired_difference(right, wrong).spread};
}

/// Within the rig's travel, or where it has been already.
bool stays_inside(const Session& session, const SessionFacts& facts) {
  const double low = std::min(session.rig.travel_m[0], facts.position_low_m);
  const double high = std::max(session.rig.travel_m[1], facts.position_high_m);
  for (const Recording& r : session.recordings) {
    for (const double y : r.y_m) {
      if (!(y >= low && y <= high)) return false;
    }
  }
  return true;
}

std::string names_of(const Explanation& one) {
  std::string names;
  for (const Term term : one.effects) names += (names.empty() ? "" : " with ") + std::string(info(term).name);
  return names.empty() ? "nothing left out" : names;
}

}  // namespace

std::optional<NextExperiment> next_experiment(const Rig& rig, const Explanation& one,
                                              const Explanation& other, const SessionFacts& facts,
                                              const FitOptions& options, unsigned threads) {
  const std::vector<Proposal> proposals = menu(rig, facts);
  std::vector<NextExperiment> judged(proposals.size());
  parallel_for(proposals.size(), threads, [&](std::size_t i) {
    const Session plan{rig, {proposals[i].recording}};
    PairedDifference least{1e300, 0};
    for (const auto& [truth, rival] : {std::pair{&one, &other}, {&other, &one}}) {
      const NoiseSize noise = noise_size(truth->fit, rig, options.damping_per_s);
      const Session data = surrogate(plan, truth->fit.model, noise, 1);
      if (!stays_inside(data, facts)) return;
      const PairedDifference d = difference(data, *truth, *rival, options);
      if (d.nats < least.nats) least = d;
    }
    const double z = (least.nats - kLeastGain) / std::max(least.spread, 1.0);
    judged[i] = {proposals[i].command, fmt::format("{} from {}", names_of(one), names_of(other)), least.nats,
                 0.5 * std::erfc(-z / std::numbers::sqrt2)};
  });
  const auto best = std::max_element(judged.begin(), judged.end(), [](const auto& a, const auto& b) {
    return a.chance != b.chance ? a.chance < b.chance : a.expected_nats < b.expected_nats;
  });
  if (best == judged.end() || best->chance < kLeastChance) return std::nullopt;
  return *best;
}

}  // namespace cartwright
