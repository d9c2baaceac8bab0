// The step test against closed forms of the second-order loop, and against limiting cases of the real one.
#include "host/design/step_test.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/design/published.hpp"

namespace cartwright::design {
namespace {

struct SecondOrder {
  double natural_rad_per_s, ratio;
  SecondOrder(const Model& m, const Gains& g)
      : natural_rad_per_s(std::sqrt(m[Parameter::voltage_gain] * g.kp_V_per_m)),
        ratio((m[Parameter::viscous_coefficient] + m[Parameter::voltage_gain] * g.kd_V_s_per_m) /
              (2 * natural_rad_per_s)) {}
  double at(double t_s) const {
    const double damped = natural_rad_per_s * std::sqrt(1 - ratio * ratio);
    return 1 - std::exp(-ratio * natural_rad_per_s * t_s) *
                   (std::cos(damped * t_s) + ratio / std::sqrt(1 - ratio * ratio) * std::sin(damped * t_s));
  }
};

TEST(StepTest, TheIdealLawGivesTheSecondOrderResponse) {
  const Gains gains{100, 4, 0};
  const SecondOrder exact(test::lm3(), gains);
  const StepRun run =
      run_step(test::lm3(), gains, Loop::continuous(), {.duration_s = 2.5, .settling_band = 0.01});
  for (std::size_t k = 0; k < run.t_s.size(); ++k) {
    ASSERT_NEAR(run.y_m[k], 0.1 * exact.at(run.t_s[k]), 1e-6) << run.t_s[k];
  }
  const double z = exact.ratio, w = exact.natural_rad_per_s;
  EXPECT_NEAR(run.metrics.overshoot, std::exp(-std::numbers::pi * z / std::sqrt(1 - z * z)), 1e-4);
  const double bandwidth = w * std::sqrt(1 - 2 * z * z + std::sqrt(4 * std::pow(z, 4) - 4 * z * z + 2));
  EXPECT_NEAR(run.metrics.bandwidth_hz, bandwidth / (2 * std::numbers::pi), 2e-3 * bandwidth);
  EXPECT_DOUBLE_EQ(run.metrics.peak_voltage_V, 10);
}

TEST(StepTest, AFastUnlimitedLoopWithoutEncoderComesNearTheIdealLaw) {
  Loop loop;
  loop.period_s = 1e-4;
  loop.voltage_limit_V = 1e6;
  loop.derivative_filter_hz = 2000;
  loop.derivative_on_measurement = true;  // Eq. 62 has no kick
  const Gains gains{100, 4, 0};
  const StepMetrics sampled = step_metrics(test::nlm3(), gains, loop, {});
  const StepMetrics ideal = step_metrics(test::nlm3(), gains, Loop::continuous(), {});
  EXPECT_NEAR(sampled.settling_time_s, ideal.settling_time_s, 3e-3);
  EXPECT_NEAR(sampled.rise_time_s, ideal.rise_time_s, 1e-3);
  EXPECT_NEAR(sampled.rms_voltage_V, ideal.rms_voltage_V, 0.01 * ideal.rms_voltage_V);
}

TEST(StepTest, TheDerivativeOfTheErrorKicksIntoTheLimitAndThatOfTheMeasurementDoesNot) {
  Loop loop;
  EXPECT_EQ(step_metrics(test::nlm3(), {60, 2, 0}, loop, {}).peak_voltage_V, 12);
  loop.derivative_on_measurement = true;
  EXPECT_NEAR(step_metrics(test::nlm3(), {60, 2, 0}, loop, {}).peak_voltage_V, 6, 1e-9);
}

TEST(StepTest, AStepDownIsTheMirrorImageOfAStepUpOnASymmetricCart) {
  const StepMetrics up = step_metrics(test::nlm3(), {80, 2, 0}, {}, {.step_m = 0.1});
  const StepMetrics down = step_metrics(test::nlm3(), {80, 2, 0}, {}, {.step_m = -0.1, .start_m = 0.1});
  EXPECT_NEAR(up.settling_time_s, down.settling_time_s, 1e-9);
  EXPECT_NEAR(up.rms_voltage_V, down.rms_voltage_V, 1e-9);
}

TEST(StepTest, ATiltedRailLeavesPdOffByTiltOverStiffnessAndPidNot) {
  Model model = test::lm3();
  model.set(Parameter::constant_acceleration, 2);
  const StepTest test{.duration_s = 8, .settling_band = 0.01};
  const StepMetrics pd = step_metrics(model, {100, 6, 0}, {}, test);
  EXPECT_NEAR(pd.final_error, 2 / (1.7866 * 100) / 0.1, 1e-6);
  EXPECT_TRUE(std::isinf(pd.settling_time_s));
  const StepMetrics pid = step_metrics(model, {100, 6, 100}, {}, test);
  EXPECT_NEAR(pid.final_error, 0, 1e-3);
  EXPECT_LT(pid.settling_time_s, 8);
}

TEST(StepTest, AHeatedMotorIsWeaker) {
  Model model = test::lm3();
  model.set(Parameter::heating_gain_loss, 0.3).set(Parameter::heating_time_constant, 100);
  const double cold = step_metrics(model, {60, 2, 0}, {}, {}).rise_time_s;
  const double warm = step_metrics(model, {60, 2, 0}, {}, {.warm = true}).rise_time_s;
  model.remove(Term::motor_heating);
  model.set(Parameter::voltage_gain, 0.7 * 1.7866);
  EXPECT_NEAR(warm, step_metrics(model, {60, 2, 0}, {}, {}).rise_time_s, 1e-3);
  EXPECT_LT(cold, warm);
}

}  // namespace
}  // namespace cartwright::design
