// The checks against Wongvanich, Hann and Sirisena (2015): their non-linear model NLm1 as the simulated cart,
// identified from the one response they used, with an encoder of 22.75 um.

#include <gtest/gtest.h>

#include <cmath>

#include "host/identify/step_response.hpp"
#include "tests/unit/identify/simulated_session.hpp"

namespace cartwright {
namespace {

/// NLm1, Eq. (73).
Model exponential_cart() {
  return Model(1.9165)
      .set(Parameter::exponential_alpha1, 17.3264)
      .set(Parameter::exponential_alpha2, 13.1068)
      .set(Parameter::exponential_gamma, 5.9986);
}

/// The paper's experiment: r = 0.1 m from the start.
SimulatedSession step(double kp, double kd, double duration_s) {
  SimulatedSession out{exponential_cart()};
  out.add(
      "step.csv", {kp, kd}, duration_s, [](double) { return 0.1; }, 0);
  out.edit().recordings.front().experiment = "step";
  return out;
}

StepIdentification identified(std::size_t intervals, std::optional<double> rise = {},
                              StepInput input = StepInput::error) {
  const SimulatedSession session = step(60, 0, 1.0);
  StepOptions options;
  options.intervals = intervals;
  options.constraints.least_rise_per_s = rise;
  options.input = input;
  const auto cut = find_step(session.get(), options);
  EXPECT_TRUE(cut) << cut.error().message;
  const auto result = identify_step(*cut, options);
  EXPECT_TRUE(result) << result.error().message;
  return *result;
}

TEST(PaperChecks, ConstantDampingFromOneResponse) {
  const StepIdentification result = identified(1);
  EXPECT_NEAR(result.model[Parameter::viscous_coefficient], 6.14, 0.03 * 6.14);
  EXPECT_NEAR(result.model[Parameter::voltage_gain], 1.81, 0.03 * 1.81);
}

TEST(PaperChecks, SixIntervalsFromOneResponse) {
  const StepIdentification result = identified(6);
  EXPECT_NEAR(result.model[Parameter::voltage_gain], 1.913, 0.02 * 1.913);
  ASSERT_EQ(result.damping.size(), 6u);
  // Fig. 10: damping rises as the cart slows down.
  EXPECT_GT(result.damping.back().damping_per_s.value, result.damping.front().damping_per_s.value + 3);
}

TEST(PaperChecks, TheMonotoneConstraintHardlyMovesTheGain) {
  const StepIdentification free = identified(6), rising = identified(6, 0.5);
  EXPECT_NEAR(rising.model[Parameter::voltage_gain], free.model[Parameter::voltage_gain],
              0.02 * free.model[Parameter::voltage_gain]);
  for (std::size_t i = 1; i < 6; ++i) {
    EXPECT_GE(rising.damping[i].damping_per_s.value, rising.damping[i - 1].damping_per_s.value + 0.5 - 1e-6);
  }
  EXPECT_LT(rising.kkt.greatest(), 1e-8);
}

TEST(PaperChecks, TheRecordedVoltageGivesTheSameModel) {
  const StepIdentification error = identified(6), voltage = identified(6, {}, StepInput::voltage);
  EXPECT_NEAR(voltage.model[Parameter::voltage_gain], error.model[Parameter::voltage_gain], 0.01 * 1.9);
}

/// Mean absolute error over one second of a response to r = 0.1 m, Table 2.
double prediction_error_m(const Model& model, const SimulatedSession& measured) {
  const Recording& recording = measured.get().recordings.front();
  const Recording predicted = simulate(model, measured.get().rig, recording);
  double sum = 0;
  for (std::size_t row = 0; row < recording.size(); ++row)
    sum += std::abs(predicted.y_m[row] - recording.y_m[row]);
  return sum / static_cast<double>(recording.size());
}

TEST(PaperChecks, TheNonLinearModelPredictsAllOfTable2ThreeTimesBetter) {
  const Model linear = identified(1).model;
  const Model nonlinear = identified(6).model;
  const std::pair<double, double> rows[] = {{60, 0},  {60, 5},  {80, 0},  {80, 5},
                                            {80, 10}, {100, 0}, {100, 5}, {100, 10}};
  double linear_m = 0, nonlinear_m = 0;
  for (const auto& [kp, kd] : rows) {
    const SimulatedSession measured = step(kp, kd, 1.0);
    const double from_linear_m = prediction_error_m(linear, measured);
    const double from_nonlinear_m = prediction_error_m(nonlinear, measured);
    RecordProperty(
        "kp" + std::to_string(int(kp)) + "_kd" + std::to_string(int(kd)),
        std::to_string(1e3 * from_linear_m) + " / " + std::to_string(1e3 * from_nonlinear_m) + " mm");
    linear_m += from_linear_m / 8;
    nonlinear_m += from_nonlinear_m / 8;
  }
  EXPECT_GE(linear_m, 3 * nonlinear_m)
      << "linear " << 1e3 * linear_m << " mm, non-linear " << 1e3 * nonlinear_m << " mm";
}

TEST(StepResponse, AClippedCommandIsRefusedByTheErrorForm) {
  // 60 V/m x 0.1 m and the derivative kick of the step: 12 V in the first rows (Table 1).
  SimulatedSession session{Model(1.9165).set(Parameter::viscous_coefficient, 6)};
  session.add("step.csv", {60, 5}, 1.2, [](double t_s) { return t_s < 0.1 ? 0.0 : 0.1; });
  session.edit().recordings.front().experiment = "step";
  StepOptions options;
  const auto refused = find_step(session.get(), options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("clipped"), std::string::npos);
  options.input = StepInput::voltage;
  const auto cut = find_step(session.get(), options);
  ASSERT_TRUE(cut) << cut.error().message;
  EXPECT_NEAR(cut->t_s.front(), 0.1, 2e-3);
  const auto result = identify_step(*cut, options);
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->model[Parameter::voltage_gain], 1.9165, 0.01);
  EXPECT_NEAR(result->model[Parameter::viscous_coefficient], 6, 0.05);
}

TEST(StepResponse, WhatIsMissingIsNamed) {
  const SimulatedSession session = step(60, 0, 1.0);
  StepOptions options;
  options.file = "other.csv";
  EXPECT_NE(find_step(session.get(), options).error().message.find("other.csv"), std::string::npos);
  Session tracks = session.get();
  tracks.recordings.front().experiment = "track";
  EXPECT_FALSE(find_step(tracks, StepOptions{}));
}

}  // namespace
}  // namespace cartwright
