#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/design/scenarios.hpp"
#include "host/relay/describing_function.hpp"
#include "host/session/session.hpp"

namespace cartwright::design {

/// The cart as tuning rules see it: beta/(s (s + c)) exp(-s L) from voltage to position.
struct SimpleCart {
  double gain_m_per_s2_V = 0;  ///< beta
  double damping_per_s = 0;    ///< c
  double dead_time_s = 0;      ///< L: half a sampling period, for the hold, and what delays there are
};

/// Where the phase passes -180 degrees: pi/2 + atan(w/c) + w L = pi.
struct UltimatePoint {
  double gain_V_per_m = 0;  ///< Ku: a proportional gain with which the loop just oscillates
  double period_s = 0;      ///< Tu
};

/// None without damping or without dead time: the phase then never passes, or only at infinity.
std::optional<UltimatePoint> ultimate_point(const SimpleCart& cart);

/// PD: Kp = 0.8 Ku, Td = Tu/8; PID: Kp = 0.6 Ku, Ti = Tu/2, Td = Tu/8 (Ziegler and Nichols, 1942).
Gains ziegler_nichols(const UltimatePoint& ultimate, bool integral);
/// PID: Kp = Ku/2.2, Ti = 2.2 Tu, Td = Tu/6.3 (Tyreus and Luyben, 1992); PD: without the integral.
Gains tyreus_luyben(const UltimatePoint& ultimate, bool integral);

/// The point of the frequency response that a dual-relay limit cycle shows: with the describing function
/// N = 4 (h1 - j h2)/(pi a) the plant has G(j w) = -1/N, so
///
///     |G| = pi a/(4 sqrt(h1^2 + h2^2))  [m/V]            arg G = -pi + atan(h2/h1)
///
/// friction included. The PD law that makes w the crossover with this phase margin has |C| = 1/|G| and
/// arg C = margin - atan(h2/h1): Kp = cos(arg C)/|G|, Kd = sin(arg C)/(w |G|) (after Astrom and Hagglund,
/// 1984). With an integral part Ki = Kp w/10. Kd is not below zero.
Gains phase_margin_gains(const RelayFeature& feature, double margin_rad, bool integral);

/// Both poles at -w0: Kp = w0^2/beta, Kd = (2 w0 - c)/beta, not below zero; PID: all three, with the third
/// pole at -w0/5.
Gains critically_damped(const SimpleCart& cart, double natural_rad_per_s, bool integral);

/// The w0 with which a critically damped response just meets the specification's settling time, or else its
/// rise time or bandwidth; or else, the one whose Kp reaches the voltage limit at the step.
double natural_frequency_for(const Specification& specification, const Loop& loop, const StepTest& step,
                             const SimpleCart& cart);

/// A rule's gains, and how the real loop does with them.
struct TuningRule {
  std::string name, from;
  Gains gains;
  StepMetrics metrics;  ///< on the model
  bool meets = false;   ///< the specification, on the model
  bool holds = false;   ///< and in every scenario
};

struct RuleComparison {
  std::vector<TuningRule> rules;
  std::vector<std::string> remarks;  ///< rules that could not be had, and why
};

/// A session of dual-relay tests simulated on a model in a loop: what a rig without recordings would have
/// shown.
Session simulated_relay_session(const Model& model, const Loop& loop);

/// Rules from the model's numbers, and from relay tests, each tried on the trials.
RuleComparison compare_rules(const Trials& trials, const Session& relay_session, bool simulated,
                             bool integral);

}  // namespace cartwright::design
