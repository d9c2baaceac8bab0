#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/design/specification.hpp"
#include "host/design/step_test.hpp"

namespace cartwright::design {

struct GainInterval {
  double low = 0, high = 0;
};

/// Where on a line of gains a question is answered with yes: a grid of `points` over [least, most], and every
/// edge between two answers laid out again in a grid of its own, three times. Never a bisection over the
/// whole line: the set that meets a specification is in general several intervals (ERRATA, Sec. 4.4). An
/// interval shorter than (most - least)/(points - 1) may be missed.
std::vector<GainInterval> yes_intervals(const std::function<bool(double)>& yes, double least, double most,
                                        int points);

/// The derivative gains in [least, most] with which a step meets the specification at this Kp (and Ki).
std::vector<GainInterval> derivative_gains(const Model& model, const Loop& loop, const StepTest& test,
                                           const Specification& specification, const Gains& others,
                                           double least, double most, int points = 401);

/// The least of them; none where there are none.
std::optional<double> least_derivative_gain(const Model& model, const Loop& loop, const StepTest& test,
                                            const Specification& specification, double kp_V_per_m,
                                            double most_kd_V_s_per_m);

}  // namespace cartwright::design
