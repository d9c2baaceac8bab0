// The written contracts of hal/interface, as tests that any backend must pass. A backend is a type that makes
// devices and moves its cart; the simulated cart is the first.

#include <gtest/gtest.h>

#include <cmath>

#include "hal/sim/simulated_cart.hpp"

namespace cartwright::hal {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

struct Simulated {
  sim::SimulatedCart cart{sim::CartSetup{}};
  Devices devices() { return cart.devices(); }
  /// Breaks the link to the encoder and to the amplifier.
  void unplug() {
    sim::Faults faults;
    faults.encoder_dead_ns = 0;
    faults.amplifier_dead_ns = 0;
    cart.set_faults(faults);
  }
  void press_emergency_stop() {
    sim::Faults faults;
    faults.emergency_stop_ns = 0;
    cart.set_faults(faults);
  }
  double true_speed() { return cart.truth().velocity_m_per_s; }
};

template <typename Backend>
class DeviceContract : public testing::Test {
 protected:
  /// One tick: reads, then holds a voltage until the next.
  Measurement tick(double voltage_V, bool enabled = true) {
    now_ns += kPeriod_ns;
    const Tick now{now_ns, kPeriod_ns};
    devices.encoder->read(now, measurement);
    devices.amplifier->report(now, report);
    devices.inputs->read(now, inputs);
    devices.amplifier->write(now, {voltage_V, enabled});
    return measurement;
  }

  Backend backend;
  Devices devices = backend.devices();
  std::int64_t now_ns = 0;
  Measurement measurement;
  AmplifierReport report;
  Inputs inputs;
};

template <typename Backend>
class EncoderContract : public DeviceContract<Backend> {};
template <typename Backend>
class AmplifierContract : public DeviceContract<Backend> {};
template <typename Backend>
class DigitalInputsContract : public DeviceContract<Backend> {};

using Backends = testing::Types<Simulated>;
TYPED_TEST_SUITE(EncoderContract, Backends);
TYPED_TEST_SUITE(AmplifierContract, Backends);
TYPED_TEST_SUITE(DigitalInputsContract, Backends);

TYPED_TEST(EncoderContract, PositionsAreWholeCounts) {
  const double resolution_m = this->devices.encoder->resolution_m();
  ASSERT_GT(resolution_m, 0);
  for (int i = 0; i < 300; ++i) {
    const double counts = this->tick(4).position_m / resolution_m;
    EXPECT_NEAR(counts, std::round(counts), 1e-6);
  }
}

TYPED_TEST(EncoderContract, PositiveVoltageDrivesTowardsPositivePositions) {
  const double start = this->tick(0).position_m;
  for (int i = 0; i < 200; ++i) this->tick(3);
  EXPECT_GT(this->tick(3).position_m, start + 0.001);
}

TYPED_TEST(EncoderContract, TheSequenceCountsReadingsAndTimeNeverRunsBack) {
  Measurement last = this->tick(1);
  for (int i = 0; i < 100; ++i) {
    const Measurement next = this->tick(1);
    EXPECT_EQ(next.validity, Validity::valid);
    EXPECT_EQ(next.sequence, last.sequence + 1);
    EXPECT_GT(next.timestamp_ns, last.timestamp_ns);
    EXPECT_EQ(next.age_ns, this->now_ns - next.timestamp_ns);
    last = next;
  }
}

TYPED_TEST(EncoderContract, AFailedReadingSaysSoAndKeepsTheLastOne) {
  for (int i = 0; i < 100; ++i) this->tick(4);
  const Measurement last = this->measurement;
  this->backend.unplug();
  for (int i = 1; i <= 5; ++i) {
    const Measurement failed = this->tick(4);
    EXPECT_EQ(failed.validity, Validity::invalid);
    EXPECT_EQ(failed.position_m, last.position_m);
    EXPECT_EQ(failed.sequence, last.sequence);
    EXPECT_EQ(failed.age_ns, i * kPeriod_ns);
  }
}

TYPED_TEST(AmplifierContract, IsOffBeforeTheFirstWrite) {
  const Tick first{kPeriod_ns, kPeriod_ns}, later{200 * kPeriod_ns, 199 * kPeriod_ns};
  this->devices.encoder->read(first, this->measurement);
  const double start = this->measurement.position_m;
  this->devices.encoder->read(later, this->measurement);
  EXPECT_EQ(this->measurement.position_m, start);
}

TYPED_TEST(AmplifierContract, HoldsAVoltageUntilTheNextWrite) {
  this->tick(3);
  this->now_ns += 200 * kPeriod_ns;  // nothing written for 200 ms
  EXPECT_GT(this->tick(3).position_m, 0.001);
}

TYPED_TEST(AmplifierContract, NotEnabledMeansNoForceWhateverTheVoltage) {
  for (int i = 0; i < 200; ++i) this->tick(12, false);
  EXPECT_EQ(this->tick(12, false).position_m, 0);
  EXPECT_EQ(this->backend.true_speed(), 0);
}

TYPED_TEST(AmplifierContract, SaysWhetherItIsThere) {
  this->tick(0);
  EXPECT_EQ(this->report.health, AmplifierHealth::good);
  this->backend.unplug();
  this->tick(0);
  EXPECT_EQ(this->report.health, AmplifierHealth::silent);
}

TYPED_TEST(DigitalInputsContract, NothingIsPressedInTheMiddleOfAFreeRail) {
  this->tick(0);
  EXPECT_EQ(this->inputs.validity, Validity::valid);
  EXPECT_FALSE(this->inputs.emergency_stop || this->inputs.low_end_stop || this->inputs.high_end_stop);
}

TYPED_TEST(DigitalInputsContract, EachEndStopClosesAtItsOwnEnd) {
  for (int i = 0; i < 3000; ++i) this->tick(6);
  EXPECT_TRUE(this->inputs.high_end_stop);
  EXPECT_FALSE(this->inputs.low_end_stop);
  for (int i = 0; i < 6000; ++i) this->tick(-6);
  EXPECT_TRUE(this->inputs.low_end_stop);
  EXPECT_FALSE(this->inputs.high_end_stop);
}

TYPED_TEST(DigitalInputsContract, TheEmergencyStopIsSeenAtOnce) {
  this->tick(0);
  this->backend.press_emergency_stop();
  this->tick(0);
  EXPECT_TRUE(this->inputs.emergency_stop);
}

TEST(Unread, DigitalInputsAreOnTheSafeSide) {
  const Inputs inputs;
  EXPECT_TRUE(inputs.emergency_stop && inputs.low_end_stop && inputs.high_end_stop);
  EXPECT_EQ(inputs.validity, Validity::invalid);
}

TEST(SimulatedCart, AHardWallStopsTheCartBehindTheSwitch) {
  sim::SimulatedCart cart{sim::CartSetup{}};
  Tick now;
  for (int i = 0; i < 5000; ++i) {
    now.now_ns += kPeriod_ns;
    cart.write(now, {12, true});
  }
  EXPECT_LT(cart.truth().position_m, 0.47);
  EXPECT_GT(cart.truth().position_m, 0.45);
}

TEST(SimulatedCart, ALateEncoderGivesOldPositionsWithTheirOwnTimes) {
  sim::SimulatedCart cart{sim::CartSetup{}};
  Measurement m;
  std::vector<double> positions;
  Tick now{0, kPeriod_ns};
  for (int i = 0; i < 200; ++i) {
    now.now_ns += kPeriod_ns;
    cart.read(now, m);
    positions.push_back(m.position_m);
    cart.write(now, {6, true});
  }
  sim::Faults faults;
  faults.encoder_late_ns = 0;
  faults.latency_ns = 10 * kPeriod_ns;
  cart.set_faults(faults);
  now.now_ns += kPeriod_ns;
  cart.read(now, m);
  EXPECT_EQ(m.age_ns, 10 * kPeriod_ns);
  EXPECT_EQ(m.position_m, positions[positions.size() - 10]);
}

TEST(SimulatedCart, ALateCommandActsOneWriteLater) {
  sim::Faults faults;
  faults.command_late_ns = 0;
  sim::SimulatedCart cart(sim::CartSetup{}, faults);
  Tick now{kPeriod_ns, kPeriod_ns};
  cart.write(now, {5, true});
  now.now_ns += kPeriod_ns;
  cart.write(now, {7, true});
  EXPECT_EQ(cart.delivered_V(), 0);
  now.now_ns += kPeriod_ns;
  cart.write(now, {0, true});
  EXPECT_EQ(cart.delivered_V(), 5);
}

TEST(SimulatedCart, TheDisturbanceActsInItsOwnRecordingAndFromItsStart) {
  sim::CartSetup setup;
  setup.model = Model(1.9)
                    .set(Parameter::disturbance_start, 0.1)
                    .set(Parameter::disturbance_duration, 0.1)
                    .set(Parameter::disturbance_peak, 2);
  setup.model.disturbance_recording = "b.csv";
  const auto moved_in = [&](std::string_view file) {
    sim::SimulatedCart cart(setup);
    Tick now{kPeriod_ns, kPeriod_ns};
    cart.write(now, {0, true});
    now.now_ns += 5'000 * kPeriod_ns;
    cart.write(now, {0, true});
    cart.recording_started(file);
    now.now_ns += 500 * kPeriod_ns;
    cart.write(now, {0, true});
    return cart.truth().position_m;
  };
  EXPECT_EQ(moved_in("a.csv"), 0);
  EXPECT_GT(moved_in("b.csv"), 1e-3);
}

}  // namespace
}  // namespace cartwright::hal
