#include <gtest/gtest.h>

#include <limits>

#include "tests/sim/rig.hpp"

namespace cartwright::firmware {
namespace {

using wire::Command;
using wire::Fault;
using wire::State;

Programme a_step(TestRig& rig) {
  return rig.one([](Settings& s) { s.set(wire::Id::experiment_kind, 1); });
}

TEST(Supervisor, LetsStatesFollowOnlyInTheirOrder) {
  TestRig rig;
  rig.ticks(1);
  const Programme step = a_step(rig);
  EXPECT_FALSE(rig.command(Command::run, step));
  EXPECT_EQ(rig.status().reason, wire::Reason::wrong_state);
  EXPECT_FALSE(rig.command(Command::stop));
  EXPECT_FALSE(rig.command(Command::reset));
  EXPECT_TRUE(rig.command(Command::arm));
  EXPECT_FALSE(rig.command(Command::arm));
  EXPECT_TRUE(rig.command(Command::run, step));
  EXPECT_EQ(rig.status().state, State::running);
  EXPECT_FALSE(rig.command(Command::run, step));
  EXPECT_TRUE(rig.command(Command::stop));
  EXPECT_EQ(rig.status().state, State::armed);
  EXPECT_EQ(rig.status().outcome, wire::Outcome::stopped);
  EXPECT_TRUE(rig.command(Command::disarm));
  EXPECT_EQ(rig.status().state, State::disarmed);
}

TEST(Supervisor, DisarmedPutsOutNothingAndLogsNothing) {
  TestRig rig;
  rig.ticks(100);
  EXPECT_EQ(rig.exchange->log.rows(), 0);
  EXPECT_EQ(rig.cart.truth().position_m, 0);
}

struct Case {
  const char* name;
  Fault fault;
  void (*breaks)(hal::sim::Faults&, std::int64_t now_ns);
  int within_ticks;  ///< of the cause until the fault
};

class EveryFault : public testing::TestWithParam<Case> {};

TEST_P(EveryFault, TakesTheVoltageInTheSameTickFreezesTheLogAndSticks) {
  TestRig rig;
  ASSERT_TRUE(rig.start(a_step(rig)));
  rig.ticks(1100);  // past the approach, in the first step
  ASSERT_EQ(rig.status().state, State::running);
  hal::sim::Faults faults;
  GetParam().breaks(faults, rig.now_ns() + TestRig::kPeriod_ns);
  rig.cart.set_faults(faults);
  int waited = 0;
  while (rig.status().state == State::running && waited < 2000) {
    rig.ticks(1);
    ++waited;
  }
  EXPECT_EQ(rig.status().state, State::faulted);
  EXPECT_EQ(rig.status().fault.fault, GetParam().fault) << wire::name(rig.status().fault.fault);
  EXPECT_LE(waited, GetParam().within_ticks);
  EXPECT_EQ(rig.status().outcome, wire::Outcome::faulted);
  EXPECT_NE(sentence(rig.status()).find(wire::words(GetParam().fault)), std::string::npos);

  // The last row is the faulting tick's own: zero volts, and the fault's number in its status.
  const LogRow last = rig.last_row();
  EXPECT_EQ(last[column::u], 0);
  EXPECT_EQ(static_cast<unsigned>(last[column::status]) >> 8U, static_cast<unsigned>(GetParam().fault));
  EXPECT_EQ(rig.recording(0).outcome, wire::Outcome::faulted);

  const std::uint64_t rows = rig.exchange->log.rows();
  EXPECT_FALSE(rig.command(Command::arm));
  rig.cart.set_faults({});
  rig.ticks(200);
  EXPECT_EQ(rig.status().fault.fault, GetParam().fault) << "a fault leaves by a reset only";
  EXPECT_EQ(rig.exchange->log.rows(), rows);
  EXPECT_TRUE(rig.status().log_frozen);
  rig.ticks(2000);
  EXPECT_TRUE(rig.command(Command::reset));
  EXPECT_EQ(rig.status().state, State::disarmed);
  EXPECT_TRUE(rig.command(Command::arm)) << sentence(rig.status().present);
}

INSTANTIATE_TEST_SUITE_P(
    OfTheDevices, EveryFault,
    testing::Values(Case{"EmergencyStop", Fault::emergency_stop,
                         [](hal::sim::Faults& f, std::int64_t now) { f.emergency_stop_ns = now; }, 1},
                    Case{"EncoderDead", Fault::encoder_dead,
                         [](hal::sim::Faults& f, std::int64_t now) { f.encoder_dead_ns = now; }, 1},
                    Case{"EncoderJump", Fault::encoder_jump,
                         [](hal::sim::Faults& f, std::int64_t now) { f.encoder_jump_ns = now; }, 1},
                    Case{"EncoderStuck", Fault::encoder_stuck,
                         [](hal::sim::Faults& f, std::int64_t now) { f.encoder_stuck_ns = now; }, 1000},
                    Case{"EncoderLate", Fault::encoder_late,
                         [](hal::sim::Faults& f, std::int64_t now) {
                           f.encoder_late_ns = now;
                           f.latency_ns = 20 * TestRig::kPeriod_ns;
                         },
                         1},
                    Case{"AmplifierDead", Fault::amplifier_dead,
                         [](hal::sim::Faults& f, std::int64_t now) { f.amplifier_dead_ns = now; }, 1},
                    Case{"AmplifierFault", Fault::amplifier_fault,
                         [](hal::sim::Faults& f, std::int64_t now) { f.amplifier_fault_ns = now; }, 1}),
    [](const auto& one) { return one.param.name; });

TEST(Supervisor, ArmingIsRefusedWhileAFaultConditionIsPresent) {
  TestRig rig;
  hal::sim::Faults faults;
  faults.emergency_stop_ns = 0;
  rig.cart.set_faults(faults);
  rig.ticks(1);
  EXPECT_FALSE(rig.command(Command::arm));
  EXPECT_EQ(rig.status().reason, wire::Reason::fault_present);
  EXPECT_EQ(rig.status().present.fault, Fault::emergency_stop);
}

TEST(Supervisor, ALostHostEndsAnExperimentButDoesNotTroubleAnIdleController) {
  TestRig rig;
  ASSERT_TRUE(rig.arm());
  rig.exchange->host_lost = true;
  rig.ticks(10);
  EXPECT_EQ(rig.status().state, State::armed);
  rig.exchange->host_lost = false;
  ASSERT_TRUE(rig.command(Command::run, a_step(rig)));
  rig.ticks(900);
  rig.exchange->host_lost = true;
  rig.ticks(1);
  EXPECT_EQ(rig.status().fault.fault, Fault::lost_host);
  EXPECT_EQ(rig.last_row()[column::u], 0);
}

TEST(Supervisor, MissedTicksAreCountedAndTooManyInARowAreAFault) {
  TestRig rig;
  ASSERT_TRUE(rig.start(a_step(rig)));
  rig.ticks(900);
  hal::Tick late{rig.now_ns() + 6 * TestRig::kPeriod_ns, 6 * TestRig::kPeriod_ns};
  rig.controller.tick(late, 5e-3, 5);
  EXPECT_EQ(rig.status().state, State::running);
  EXPECT_EQ(rig.status().missed_ticks, 5);
  EXPECT_EQ(rig.last_row()[column::missed], 5);
  EXPECT_EQ(rig.status().lost_rows, 5);
  late.now_ns += 22 * TestRig::kPeriod_ns;
  rig.controller.tick(late, 21e-3, 21);
  EXPECT_EQ(rig.status().fault.fault, Fault::missed_ticks);
  EXPECT_EQ(rig.last_row()[column::u], 0);
}

TEST(Supervisor, TheTravelLimitStopsTheCartInsideTheTravelAndItCanBeDrivenBack) {
  RigFile file;
  file.rig.travel_m = {-0.4, 0.15};
  file.travel_margin_m = 0.03;
  TestRig rig(cart(), file);
  // 0.1 m is inside the travel, but with Kp = 60 and no damping the cart overshoots to 0.14 m.
  ASSERT_TRUE(rig.start(a_step(rig)));
  ASSERT_TRUE(rig.finish());
  EXPECT_EQ(rig.status().fault.fault, Fault::travel_limit);
  EXPECT_EQ(rig.last_row()[column::u], 0);
  rig.ticks(3000);
  EXPECT_GT(rig.cart.truth().position_m, 0.12);
  ASSERT_TRUE(rig.command(Command::reset));
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) {
    s.set(wire::Id::experiment_kind, 6);
    s.set(wire::Id::experiment_duration_s, 1);
  })));
  ASSERT_TRUE(rig.finish());
  EXPECT_EQ(rig.status().outcome, wire::Outcome::finished);
  EXPECT_LT(std::abs(rig.cart.truth().position_m), 0.01);
}

TEST(Supervisor, AnEndStopIsAFaultOfItsOwn) {
  RigFile file;
  file.travel_margin_m = 0;
  file.end_stop_m = 0;
  file.rig.travel_m = {-0.4, 0.12};
  TestRig rig(cart(), file);
  ASSERT_TRUE(rig.start(a_step(rig)));
  ASSERT_TRUE(rig.finish());
  EXPECT_EQ(rig.status().fault.fault, Fault::end_stop);
}

TEST(OutputStage, ANumberThatIsNoneGivesZeroVoltsAndSaysSo) {
  OutputStage stage(12, 5e4);
  EXPECT_EQ(stage.shape(5, 1e-3).voltage_V, 5);
  const auto out = stage.shape(std::numeric_limits<double>::quiet_NaN(), 1e-3);
  EXPECT_FALSE(out.finite);
  EXPECT_EQ(out.voltage_V, 0);
}

TEST(OutputStage, SaysWhetherVoltageOrSlewLimitHoldsItBack) {
  OutputStage stage(12, 1000);  // 1 V per tick
  auto out = stage.shape(5, 1e-3);
  EXPECT_EQ(out.voltage_V, 1);
  EXPECT_EQ(out.limited_by, wire::Limited::slew);
  for (int i = 0; i < 20; ++i) out = stage.shape(100, 1e-3);
  EXPECT_EQ(out.voltage_V, 12);
  EXPECT_EQ(out.limited_by, wire::Limited::voltage);
  out = stage.shape(11.5, 1e-3);
  EXPECT_EQ(out.limited_by, wire::Limited::nothing);
}

TEST(Supervisor, GainsThatBlowUpAreCaughtBeforeTheAmplifier) {
  TestRig rig;
  Programme programme = a_step(rig);
  programme.runs[0].law = PdGains{std::numeric_limits<double>::infinity(), 0, 50, false};
  ASSERT_TRUE(rig.start(programme));
  rig.finish();
  EXPECT_EQ(rig.status().fault.fault, Fault::command_not_finite);
  EXPECT_EQ(rig.last_row()[column::u], 0);
}

}  // namespace
}  // namespace cartwright::firmware
