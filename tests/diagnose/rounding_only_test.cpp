#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/diagnose/diagnosis.hpp"
#include "host/diagnose/fit/basis.hpp"
#include "host/diagnose/judge/surrogate.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// Three steps to and fro with time to creep to rest, by a cart that is exactly `model` but for the rounding
/// of its readings. The encoder is coarse and the controller soft, so that it creeps on for seconds at counts
/// that follow each other too soon for it to rest.
Session steps_of(const Model& model) {
  constexpr double kHold_s = 1.6, kStep_m = 0.1;
  Session session;
  session.rig.encoder_resolution_m = 1e-4;
  for (const char* file : {"step_1.csv", "step_2.csv", "step_3.csv"}) {
    Recording r;
    r.file = file, r.experiment = "step", r.controller = PdGains{20, 0, 50, false};
    for (int k = 0; k < 6000; ++k) {
      r.t_s.push_back(k * session.rig.period_s());
      r.r_m.push_back(std::fmod(r.t_s.back(), 2 * kHold_s) < kHold_s ? kStep_m : 0);
    }
    r.y_m.resize(r.t_s.size());
    r.y_m.front() = 1e-3 * static_cast<double>(session.recordings.size());
    r.u_V.resize(r.t_s.size());
    session.recordings.push_back(std::move(r));
  }
  return surrogate(session, model, {}, 1);
}

TEST(RoundingOnly, WhatACreepingCartSeemsToLackOneThatIsTheModelLacksAsWell) {
  const Model truth = Model(1.9)
                          .set(P::exponential_alpha1, 17)
                          .set(P::exponential_alpha2, 13)
                          .set(P::exponential_gamma, 6)
                          .set(P::cogging_amplitude, 0.1)
                          .set(P::cogging_period, 0.016);
  const Session session = steps_of(truth);
  const FitOptions options = options_for(session, truth);
  const Fit found = fit(session, truth, search_noise(session, truth, options),
                        free_parameters(truth, facts_of(session)), options);
  const Location location = locate(session, found, alike(session, found, options), options);
  const auto acceleration = std::find_if(location.axes.begin(), location.axes.end(), [](const AxisMap& axis) {
    return axis.axis == "acceleration_m_per_s2";
  });
  ASSERT_NE(acceleration, location.axes.end());
  EXPECT_GT(acceleration->gain, 3 * acceleration->mean()) << "else this test shows nothing";
  EXPECT_GT(acceleration->alike_gain, 0.5 * acceleration->gain);
  for (const AxisMap& axis : location.axes) EXPECT_TRUE(axis.flat()) << axis.axis << ' ' << axis.parity;
}

TEST(RoundingOnly, AFaintDragIsADragAndNoFriction) {
  test::IndependentCart cart;
  cart.noise = 0;
  cart.push = [](double, double, double v) { return -0.04 * v * std::abs(v); };
  const Diagnosis d = diagnose(test::battery(cart), test::nominal(1.9, 5, 0.4));
  ASSERT_EQ(d.effects.size(), 1u);
  EXPECT_EQ(info(d.effects.front().term).name, info(Term::quadratic_drag).name);
}

}  // namespace
}  // namespace cartwright
