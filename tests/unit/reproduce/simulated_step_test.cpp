#include "host/reproduce/simulated_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cartwright::reproduce {
namespace {

/// Step response of w^2/(s^2 + 2 zeta w s + w^2), zeta < 1.
std::vector<double> second_order(double zeta, double w, double period_s, double length_s) {
  std::vector<double> y;
  const double root = std::sqrt(1 - zeta * zeta), wd = w * root;
  for (double t = 0; t <= length_s; t += period_s)
    y.push_back(1 - std::exp(-zeta * w * t) * (std::cos(wd * t) + zeta / root * std::sin(wd * t)));
  return y;
}

TEST(IdealResponse, OfALinearModelIsTheTextbookSecondOrderSystem) {
  const auto& m = kPublishedLinear[0];
  const IdealResponse r = ideal_response(m.model(), {60, 5}, 1);
  const double w = std::sqrt(m.beta_m_per_s2_V * 60);
  const double zeta = (m.c_per_s + m.beta_m_per_s2_V * 5) / (2 * w);
  const auto exact = second_order(zeta, w, 1e-3, 1);
  for (std::size_t i = 0; i < exact.size(); ++i)
    ASSERT_NEAR(r.y_m[i], kStep_m * exact[i], 1e-6);  // a twentieth of a count
  EXPECT_NEAR(r.u_V.front(), 60 * kStep_m, 1e-12);
}

TEST(SteppedTransferFunction, StartsTheCartAtTheImpulseOfTheStepsDerivative) {
  // (beta Kd s + beta Kp)/(s^2 + (c + beta Kd) s + beta Kp): the step response above plus Kd/Kp times its
  // slope.
  const auto& m = kPublishedLinear[0];
  const double kp = 60, kd = 5, beta = m.beta_m_per_s2_V;
  const double w = std::sqrt(beta * kp), zeta = (m.c_per_s + beta * kd) / (2 * w);
  const double period_s = 1e-4, wd = w * std::sqrt(1 - zeta * zeta);
  design::StepTest test;
  test.step_m = kStep_m;
  test.duration_s = 1;
  const auto run = design::run_step(m.model(), {kp, kd}, stepped_transfer_function(period_s), test);
  const auto without = second_order(zeta, w, period_s, 1);
  for (std::size_t i = 0; i < without.size(); i += 100) {
    const double t = run.t_s[i];
    const double slope = w * w / wd * std::exp(-zeta * w * t) * std::sin(wd * t);
    ASSERT_NEAR(run.y_m[i], kStep_m * (without[i] + kd / kp * slope), 2e-3 * kStep_m) << t;
  }
  EXPECT_NEAR((run.y_m[2] - run.y_m[1]) / period_s, beta * kd * kStep_m, 0.01 * beta * kd * kStep_m);
}

TEST(SimulatedStep, ClipsTheKickOfTheDerivativeAtTheStep) {
  StepSetup setup;
  setup.gains = {60, 5};
  const Session session = simulated_step(cart_at(60), setup);
  const Recording& r = session.recordings.front();
  EXPECT_EQ(r.u_V[step_row(r)], session.rig.voltage_limit_V);
  EXPECT_EQ(r.u_V[step_row(r) - 1], 0);
}

}  // namespace
}  // namespace cartwright::reproduce
