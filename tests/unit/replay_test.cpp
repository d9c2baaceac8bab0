#include "host/evaluate/replay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/model/plant.hpp"
#include "host/evaluate/closed_loop.hpp"
#include "host/evaluate/evaluate.hpp"
#include "host/session/segments.hpp"

namespace cartwright {
namespace {

/// A cart driven by a square voltage, recorded without rounding at jittering times.
Recording drive(const Model& model, std::size_t rows, double amplitude_V, double half_period_s = 0.4) {
  Recording recording;
  recording.file = "drive.csv";
  Plant plant(model);
  plant.reset(0.02, 0.15);
  double t_s = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const double u_V = std::fmod(t_s, 2 * half_period_s) < half_period_s ? amplitude_V : -amplitude_V;
    recording.t_s.push_back(t_s);
    recording.y_m.push_back(plant.state().position_m);
    recording.u_V.push_back(u_V);
    const double step_s = 1e-3 + 1e-5 * std::sin(static_cast<double>(row));
    plant.advance(u_V, step_s);
    t_s += step_s;
  }
  return recording;
}

Model cart() {
  return Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::coulomb_level, 0.5);
}

TEST(Replay, TheTrueModelPredictsEveryRow) {
  const std::vector<Model> models{
      cart(),
      cart().set(Parameter::transport_delay, 4.2e-3),
      cart().set(Parameter::armature_time_constant, 5e-3),
      cart().set(Parameter::presliding_stiffness, 3e4),
      cart().set(Parameter::backlash_gap, 5e-4),
  };
  for (const Model& model : models) {
    const Recording recording = drive(model, 2600, 3);
    const double rms_m = squared_error(replay_windows(model, recording), recording.y_m).rms_m();
    EXPECT_LT(rms_m, 2e-6);
    EXPECT_LT(open_loop_error(replay_open_loop(model, recording), recording).rms_m(), 2e-5);
  }
}

TEST(Replay, TwoMassesTakenAsLinearByStepsMissByNearlyTheSame) {
  const Model truth = cart()
                          .set(Parameter::backlash_gap, 5e-4)
                          .set(Parameter::backlash_contact_resonance, 250)
                          .set(Parameter::stribeck_excess, 0.4)
                          .set(Parameter::stribeck_speed, 0.03);
  const Recording recording = drive(truth, 2600, 3);
  const Model wrong = Model(truth).set(Parameter::stribeck_excess, 0.2);
  ReplayOptions options;
  const double exact_m = squared_error(replay_windows(wrong, recording, options), recording.y_m).rms_m();
  options.linear_by_steps = true;
  const double by_steps_m = squared_error(replay_windows(wrong, recording, options), recording.y_m).rms_m();
  EXPECT_GT(exact_m, 1e-5);
  EXPECT_NE(by_steps_m, exact_m);
  EXPECT_NEAR(by_steps_m, exact_m, 0.01 * exact_m);
}

TEST(Replay, AWrongGainShowsInWindowsAndGrowsOpenLoop) {
  const Recording recording = drive(cart(), 2600, 3);
  const Model wrong = cart().set(Parameter::voltage_gain, 1.9 * 1.05);
  const double window_m = squared_error(replay_windows(wrong, recording), recording.y_m).rms_m();
  const double open_m = open_loop_error(replay_open_loop(wrong, recording), recording).rms_m();
  EXPECT_GT(window_m, 1e-4);
  EXPECT_GT(open_m, 2 * window_m);
}

TEST(Replay, ACartThatSticksAllAlongIsPredictedAtRest) {
  Recording recording = drive(cart(), 1500, 0.0);
  for (std::size_t row = 0; row < recording.size(); ++row) recording.y_m[row] = 0.1;
  for (double& u_V : recording.u_V) u_V = 0.2;
  for (const double y_m : replay_windows(cart(), recording)) EXPECT_NEAR(y_m, 0.1, 1e-7);
}

TEST(Replay, TheFittedStartIsAMinimum) {
  // Any other start state of the same window has a larger error: tried around the fitted one.
  Model model = cart();
  const Recording recording = drive(model, 500, 3);
  const Model wrong = cart().set(Parameter::viscous_coefficient, 6);
  const std::vector<double> fitted_m = replay_windows(wrong, recording);
  const double best = squared_error(fitted_m, recording.y_m).sum_m2;
  const double velocity = (fitted_m[1] - fitted_m[0]) / (recording.t_s[1] - recording.t_s[0]);
  for (const double dy : {-2e-5, 0.0, 2e-5}) {
    for (const double dv : {-2e-3, 0.0, 2e-3}) {
      if (dy == 0 && dv == 0) continue;
      Plant plant(wrong);
      plant.reset(fitted_m[0] + dy, velocity + dv);
      SquaredError other;
      for (std::size_t row = 0; row < recording.size(); ++row) {
        other.add(plant.state().position_m, recording.y_m[row]);
        if (row + 1 < recording.size())
          plant.advance(recording.u_V[row], recording.t_s[row + 1] - recording.t_s[row]);
      }
      EXPECT_GT(other.sum_m2, best);
    }
  }
}

/// Of a model without position in its physics another start is a shift: squared error from a start velocity
/// and the best position.
double best_m2_from(const Model& model, const Recording& recording, double velocity_m_per_s) {
  Plant plant(model);
  plant.reset(recording.y_m.front(), velocity_m_per_s);
  double sum = 0, squares = 0;
  for (std::size_t row = 0; row < recording.size(); ++row) {
    const double e = plant.state().position_m - recording.y_m[row];
    sum += e, squares += e * e;
    if (row + 1 < recording.size())
      plant.advance(recording.u_V[row], recording.t_s[row + 1] - recording.t_s[row]);
  }
  return squares - sum * sum / static_cast<double>(recording.size());
}

/// While the cart still stands a model that starts slowly stops too, so near standstill the error does not
/// depend on the start velocity. That of a wrong model is least from a fast start.
TEST(Replay, TheStartOfACartAtRestIsTheBestOfAll) {
  Recording recording = drive(cart(), 500, 0);
  recording.r_m.assign(recording.size(), 0);
  std::fill(recording.r_m.begin() + 250, recording.r_m.end(), 0.12);
  recording.y_m.front() = 0;
  recording.controller = PdGains{60, 0, 50};
  recording = simulate(cart(), Rig(), recording);
  for (const double gain_m_per_s2_V : {1.5, 2.3}) {
    for (const double level_m_per_s2 : {0.5, 1.0, 2.0}) {
      const Model wrong =
          cart().set(Parameter::voltage_gain, gain_m_per_s2_V).set(Parameter::coulomb_level, level_m_per_s2);
      const double fitted_m2 = squared_error(replay_windows(wrong, recording), recording.y_m).sum_m2;
      double best_m2 = fitted_m2;
      for (double v = -0.8; v < 0.8; v += 0.002)
        best_m2 = std::min(best_m2, best_m2_from(wrong, recording, v));
      EXPECT_LT(fitted_m2, 1.1 * best_m2) << gain_m_per_s2_V << " " << level_m_per_s2;
    }
  }
}

TEST(Replay, WindowsNeverCrossAGap) {
  Recording recording = drive(cart(), 2000, 3);
  // Half a second of rows is lost, and the encoder is re-zeroed meanwhile: no window may see both sides.
  const auto cut = [](std::vector<double>& column) {
    column.erase(column.begin() + 700, column.begin() + 1200);
  };
  cut(recording.t_s);
  cut(recording.y_m);
  cut(recording.u_V);
  for (std::size_t row = 700; row < recording.size(); ++row) recording.y_m[row] += 0.05;
  ASSERT_EQ(segments(recording.t_s).size(), 2u);
  EXPECT_LT(squared_error(replay_windows(cart(), recording), recording.y_m).rms_m(), 2e-6);
  EXPECT_LT(open_loop_error(replay_open_loop(cart(), recording), recording).rms_m(), 2e-5);
}

/// A step that is simulated, then robbed of the rows between 0.15 s and 0.25 s.
struct RobbedStep {
  Recording whole, robbed;
  std::size_t first = 150, last = 250;
  ClosedLoopOptions exact;

  RobbedStep() {
    exact.quantise = false;
    whole.file = "step.csv";
    whole.controller = PdGains{60, 2, 50};
    for (int tick = 0; tick < 1000; ++tick) whole.t_s.push_back(1e-3 * tick);
    whole.y_m.assign(whole.t_s.size(), 0);
    whole.u_V = whole.y_m;
    whole.r_m.assign(whole.t_s.size(), 0.1);
    whole = simulate(cart(), Rig{}, whole, exact);
    robbed = whole;
    for (auto* column : {&robbed.t_s, &robbed.r_m, &robbed.y_m, &robbed.u_V}) {
      column->erase(column->begin() + static_cast<std::ptrdiff_t>(first),
                    column->begin() + static_cast<std::ptrdiff_t>(last));
    }
    robbed.other_columns.clear();
  }
};

TEST(Replay, TheControllerTicksOnWhereRowsAreLost) {
  const RobbedStep step;
  const Recording again = simulate(cart(), Rig{}, step.robbed, step.exact);
  for (std::size_t row = step.first; row < again.size(); ++row)
    ASSERT_NEAR(again.y_m[row], step.whole.y_m[row + 100], 1e-9) << row;
}

TEST(Replay, TheCommandHoldsOverTicksThatWereMissed) {
  RobbedStep step;
  std::vector<double>& missed = step.robbed.other_columns["missed_ticks"];
  missed.assign(step.robbed.size(), 0);
  missed[step.first] = 100;
  const Recording again = simulate(cart(), Rig{}, step.robbed, step.exact);
  Plant plant(cart());
  plant.reset(again.y_m[step.first - 1], again.other_columns.at("truth_v_m_per_s")[step.first - 1]);
  plant.advance(again.u_V[step.first - 1], 0.101);
  EXPECT_NEAR(again.y_m[step.first], plant.state().position_m, 1e-9);
  EXPECT_GT(std::abs(again.y_m[step.first] - step.whole.y_m[step.last]), 1e-3);
}

TEST(Replay, AForeignRecordingHasNoClosedLoop) {
  const Recording recording = drive(cart(), 600, 3);
  const Prediction prediction = predict(cart(), Rig{}, recording);
  EXPECT_EQ(prediction.closed_loop.rows, 0u);
  EXPECT_TRUE(std::isnan(prediction.closed_loop.rms_m()));
  const CsvTable table = to_table(prediction, recording);
  EXPECT_TRUE(std::isnan(table.find("y_closed_loop_m")->at(10)));
  EXPECT_EQ(table.rows(), recording.size());
}

}  // namespace
}  // namespace cartwright
