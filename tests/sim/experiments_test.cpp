#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/sim/rig.hpp"

namespace cartwright::firmware {
namespace {

using wire::Id;
using wire::Outcome;

TEST(StepReference, FollowsItsPattern) {
  Step single({0.1, StepPattern::single, 1, 0.2, 1.5, 6});
  Step alternating({0.1, StepPattern::alternating, 1, 0.2, 1.5, 6});
  Step ladder({0.4, StepPattern::ladder, 2, 0.2, 1, 6});
  EXPECT_EQ(single.at(0.199, 0).reference_m, 0);
  EXPECT_EQ(single.at(5, 0).reference_m, 0.1);
  EXPECT_EQ(alternating.at(1.699, 0).reference_m, 0.1);
  EXPECT_EQ(alternating.at(1.701, 0).reference_m, 0);
  const double levels[] = {0.2, 0.4, 0.2, 0, 0.2};
  for (int k = 0; k < 5; ++k) EXPECT_EQ(ladder.at(0.7 + k, 0).reference_m, levels[k]);
}

TEST(SweepReference, HasTheAskedSpeedsBothWaysAndNoJumps) {
  Sweep sweep({0.15, 0.1, 0.3, 2, 1});
  double last = sweep.at(0, 0).reference_m, fastest = 0;
  EXPECT_EQ(last, -0.15);
  std::set<int> speeds_mm_per_s;
  for (double t = 1e-3; t < sweep.duration_s(); t += 1e-3) {
    const double r = sweep.at(t, 0).reference_m;
    const double speed = (r - last) / 1e-3;
    fastest = std::max(fastest, std::abs(speed));
    EXPECT_LE(std::abs(r), 0.15 + 1e-12);
    if (std::abs(r) < 0.02) speeds_mm_per_s.insert(static_cast<int>(std::lround(1e3 * speed)));
    last = r;
  }
  EXPECT_EQ(speeds_mm_per_s, (std::set<int>{-300, -100, 100, 300}));
  EXPECT_LE(fastest, 0.3 + 1e-9);
}

TEST(MultisineShape, ReachesItsAmplitudeRestsAtItsEndsAndHasDifferentLines) {
  MultisineSetup setup;
  setup.amplitude = 0.11;
  const Multisine shape(setup);
  double greatest = 0;
  for (int tick = 0; tick < 8000; ++tick) greatest = std::max(greatest, std::abs(shape.at(tick * 1e-3)));
  EXPECT_NEAR(greatest, 0.11, 1e-9);
  EXPECT_EQ(shape.at(0), 0);
  EXPECT_NEAR(shape.at(8), 0, 1e-12);
  std::set<double> lines;
  for (std::size_t i = 0; i < shape.lines(); ++i) {
    lines.insert(shape.frequency_hz(i));
    const double periods = shape.frequency_hz(i) * setup.duration_s;
    EXPECT_NEAR(periods, std::round(periods), 1e-9) << "a line is periodic in the recording";
  }
  EXPECT_EQ(lines.size(), 10);
  setup.seed = 2;
  EXPECT_NE(Multisine(setup).at(3.3), shape.at(3.3));
}

TEST(RelayWatch, ConvergesOnASteadyOscillationAndMeasuresIt) {
  RelaySetup setup;
  setup.duration_s = 60;
  Relay relay(setup);
  Demand demand;
  double t = 0;
  for (; demand.outcome == Outcome::running && t < 59; t += 1e-3)
    demand = relay.at(t, 0.05 * std::sin(2 * M_PI * 2 * t));
  EXPECT_EQ(demand.outcome, Outcome::converged);
  EXPECT_NEAR(relay.period_s(), 0.5, 1.1e-3);
  EXPECT_NEAR(relay.amplitude_m(), 0.05, 1e-4);
  // One second to settle, four cycles that agree, four more for the measurement: some 5 s of 0.5 s cycles.
  EXPECT_GT(t, 1 + 8 * 0.5 - 0.6);
  EXPECT_LT(t, 1 + 10 * 0.5);
}

TEST(RelayWatch, GivesUpOnWhatDoesNotSettle) {
  RelaySetup setup;
  setup.duration_s = 600;
  Relay still(setup), wandering(setup);
  Demand demand;
  double t = 0;
  for (; demand.outcome == Outcome::running && t < 599; t += 1e-3) demand = still.at(t, 0.02);
  EXPECT_EQ(demand.outcome, Outcome::not_converged);
  EXPECT_LT(t, 5) << "a cart that sticks is no limit cycle";
  demand = {};
  for (t = 0; demand.outcome == Outcome::running && t < 599; t += 1e-3) {
    demand = wandering.at(t, (0.05 + 0.03 * std::sin(0.9 * t)) * std::sin(2 * M_PI * 2 * t));
  }
  EXPECT_EQ(demand.outcome, Outcome::not_converged);
  EXPECT_LT(t, 60);
}

TEST(Experiments, TheDualRelayStopsByItselfOnTheCart) {
  TestRig rig;
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) { s.set(Id::experiment_kind, 2); })));
  ASSERT_TRUE(rig.finish());
  EXPECT_EQ(rig.status().outcome, Outcome::converged);
  EXPECT_LT(rig.recording(0).rows, 20'000);
  EXPECT_EQ(rig.recording(0).law, wire::Law::dual_relay);
}

TEST(Experiments, ARelayTestStartsToOneSideSoThatItsPhaseIsNotLeftToOneCount) {
  TestRig rig;
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) { s.set(Id::experiment_kind, 2); })));
  ASSERT_TRUE(rig.finish());
  const RigFile standard;
  const double start_m = relay_start_m(standard);
  EXPECT_LT(start_m, -0.01);
  const std::vector<LogRow> rows = rig.rows_of(0);
  EXPECT_NEAR(rows[0][column::y], start_m, -0.1 * start_m) << "as near as friction lets the approach come";
  // Both relays push the same way until the cart is back at zero.
  std::size_t first = 0;
  while (rows[first][column::y] < -1e-4) EXPECT_EQ(rows[first++][column::u], rows[0][column::u]);
  EXPECT_GT(first, 20u);
}

TEST(Experiments, AReferenceOutsideTheTravelIsRefused) {
  const RigFile rig;
  Settings settings;
  settings.set(Id::experiment_kind, 1);
  settings.set(Id::step_amplitude_m, 0.5);
  const auto programme = prepare(settings, rig);
  ASSERT_FALSE(programme);
  EXPECT_NE(programme.error().message.find("step_amplitude_m asks for 0.5 m"), std::string::npos);
  settings.set(Id::experiment_kind, 4);
  settings.set(Id::sweep_fastest_m_per_s, 2);
  EXPECT_FALSE(prepare(settings, rig));
}

TEST(Experiments, EveryKindRunsToItsEnd) {
  for (int kind = 1; kind <= 6; ++kind) {
    TestRig rig;
    ASSERT_TRUE(rig.start(rig.one([&](Settings& s) {
      s.set(Id::experiment_kind, kind);
      s.set(Id::relay_stop, 0);
    })));
    ASSERT_TRUE(rig.finish());
    EXPECT_EQ(rig.status().state, wire::State::armed) << kind << ": " << sentence(rig.status());
    EXPECT_EQ(rig.recording(0).kind, static_cast<wire::ExperimentKind>(kind));
    EXPECT_GE(rig.recording(0).rows, 6000);
    EXPECT_EQ(rig.status().progress, 1);
  }
}

/// The contract's laws, written out again here, applied to the logged reference, reading and added voltage.
void expect_the_contracts_law(const RecordingEntry& entry, const std::vector<LogRow>& rows) {
  constexpr double kTs = 1e-3, kLimit = 12;
  double integral = 0, filtered = 0, e_prev = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double e = rows[k][column::r] - rows[k][column::y];
    double u = 0;
    if (entry.law == wire::Law::dual_relay) {
      integral += e * kTs;
      u = entry.relay.h1_V * (e >= 0 ? 1 : -1) + entry.relay.h2_V * (integral >= 0 ? 1 : -1);
    } else {
      if (k == 0) e_prev = e;
      filtered += (1 - std::exp(-2 * M_PI * entry.pd.pd.derivative_filter_hz * kTs)) *
                  ((e - e_prev) / kTs - filtered);
      e_prev = e;
      u = entry.pd.pd.kp_V_per_m * e + entry.pd.pd.kd_V_s_per_m * filtered;
    }
    u = std::clamp(u + rows[k][column::d], -kLimit, kLimit);
    ASSERT_NEAR(rows[k][column::u], u, 1e-9) << entry.file.view() << " row " << k;
  }
}

TEST(Battery, MakesTheTenStandardRecordingsEachByTheContractsLaw) {
  const RigFile file;
  TestRig rig(cart(), file, 150'000);
  ASSERT_TRUE(rig.start(battery(rig.rig)));
  ASSERT_TRUE(rig.finish());
  EXPECT_EQ(rig.status().outcome, Outcome::finished) << sentence(rig.status());
  ASSERT_EQ(rig.status().recordings, 10);
  int repeats = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    const RecordingEntry entry = rig.recording(i);
    const auto rows = rig.rows_of(i);
    ASSERT_EQ(rows.size(), entry.rows);
    EXPECT_GE(rows.size(), 6000);
    EXPECT_LE(rows.size(), 9000);
    expect_the_contracts_law(entry, rows);
    if (entry.repeat_of > 0) {
      ++repeats;
      EXPECT_EQ(rig.recording(entry.repeat_of - 1U).file.view(), "step_kp60_1.csv");
      const auto original = rig.rows_of(entry.repeat_of - 1U);
      for (std::size_t k = 0; k < rows.size(); ++k) ASSERT_EQ(rows[k][column::r], original[k][column::r]);
    }
  }
  EXPECT_EQ(repeats, 2);
}

TEST(Battery, ShrinksToAShortRailWithoutTouchingItsEnds) {
  RigFile file;
  file.rig.travel_m = {-0.12, 0.12};
  file.travel_margin_m = 0.005;
  TestRig rig(cart(), file, 150'000);
  ASSERT_TRUE(rig.start(battery(rig.rig)));
  ASSERT_TRUE(rig.finish());
  EXPECT_EQ(rig.status().outcome, Outcome::finished) << sentence(rig.status());
}

TEST(Experiments, TheStepResponseIsThatOfTheLinearLoopWithoutFriction) {
  // y'' = b u - c y', u = Kp (r - y): wn = sqrt(b Kp), zeta = c / (2 wn); first overshoot exp(-pi
  // zeta/sqrt(1-zeta^2)).
  TestRig rig(Model(1.9).set(Parameter::viscous_coefficient, 5));
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) {
    s.set(Id::experiment_kind, 1);
    s.set(Id::step_pattern, 0);
    s.set(Id::experiment_own_gains, 1);
    s.set(Id::experiment_kp_V_per_m, 60);
    s.set(Id::experiment_kd_V_s_per_m, 0);
  })));
  ASSERT_TRUE(rig.finish());
  double peak = 0;
  for (const LogRow& row : rig.rows_of(0)) peak = std::max(peak, row[column::truth_y]);
  // The command is held for a tick, which is half a tick of delay on average: damping lost wn Ts / 4 ~ 0.003.
  const double wn = std::sqrt(1.9 * 60), zeta = 5 / (2 * wn) - wn * 1e-3 / 4;
  EXPECT_NEAR(peak / 0.1 - 1, std::exp(-M_PI * zeta / std::sqrt(1 - zeta * zeta)), 0.005);
}

}  // namespace
}  // namespace cartwright::firmware
