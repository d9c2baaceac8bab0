#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/files/files.hpp"
#include "common/wire/codec.hpp"
#include "firmware/gain_store.hpp"
#include "tests/sim/rig.hpp"

namespace cartwright::firmware {
namespace {

namespace fs = std::filesystem;

class GainFile : public testing::Test {
 protected:
  void SetUp() override {
    directory = fs::temp_directory_path() / ("cartwright-gains-" + std::to_string(::getpid()));
    fs::create_directories(directory);
    file = directory / "gains.txt";
  }
  void TearDown() override { fs::remove_all(directory); }
  fs::path directory, file;
};

TEST_F(GainFile, AlternatesBetweenTheSlotsAndTheNewestIsActiveAtTheNextStart) {
  auto store = GainStore::open(file).value();
  EXPECT_EQ(store.active(), 0);
  ASSERT_TRUE(store.store({60, 1, 50, false}));
  ASSERT_TRUE(store.store({70, 2, 40, true}));
  EXPECT_EQ(store.active(), 2);
  ASSERT_TRUE(store.store({80, 3, 30, false}));
  const auto again = GainStore::open(file).value();
  EXPECT_EQ(again.active(), 1);
  EXPECT_EQ(again.slot(1)->gains.pd.kp_V_per_m, 80);
  EXPECT_EQ(again.slot(1)->generation, 3);
  EXPECT_EQ(again.slot(2)->gains.pd.derivative_filter_hz, 40);
  EXPECT_TRUE(again.slot(2)->gains.pd.derivative_on_measurement);
}

TEST_F(GainFile, ASlotWithOneWrongByteIsNotBelievedAndTheOtherTakesOver) {
  auto store = GainStore::open(file).value();
  ASSERT_TRUE(store.store({60, 1, 50, false}));
  ASSERT_TRUE(store.store({70, 2, 50, false}));
  std::string text = read_file(file).value();
  text.replace(text.find("kp_V_per_m 70"), 13, "kp_V_per_m 79");
  ASSERT_TRUE(write_file(file, text));
  const auto again = GainStore::open(file).value();
  EXPECT_FALSE(again.slot(2));
  EXPECT_EQ(again.active(), 1);
  EXPECT_EQ(again.slot(1)->gains.pd.kp_V_per_m, 60);
  ASSERT_EQ(again.doubts().size(), 1u);
  EXPECT_NE(again.doubts()[0].find(":2: checksum"), std::string::npos) << again.doubts()[0];
}

TEST_F(GainFile, GainsOutOfBoundsChangeNothing) {
  auto store = GainStore::open(file).value();
  ASSERT_TRUE(store.store({60, 1, 50, false}));
  const std::string before = read_file(file).value();
  EXPECT_FALSE(store.store({1e9, 1, 50, false}));
  EXPECT_FALSE(store.store({60, std::nan(""), 50, false}));
  EXPECT_FALSE(store.activate(2));
  EXPECT_EQ(store.active(), 1);
  EXPECT_EQ(read_file(file).value(), before);
}

TEST_F(GainFile, KeepsTheIntegralGainAndReadsFilesFromBeforeItWasThere) {
  auto store = GainStore::open(file).value();
  ASSERT_TRUE(store.store({{60, 1, 50, false}, 120}));
  EXPECT_EQ(GainStore::open(file).value().slot(1)->gains.ki_V_per_m_s, 120);
  EXPECT_FALSE(store.store({{60, 1, 50, false}, -1}));
  const std::string body =
      "slot 1 generation 3 kp_V_per_m 60 kd_V_s_per_m 2 derivative_filter_hz 50 on_measurement 0";
  const auto bytes = std::span(reinterpret_cast<const std::uint8_t*>(body.data()), body.size());
  ASSERT_TRUE(write_file(file, fmt::format("{} crc {:08x}\n", body, wire::crc32(bytes))));
  const auto old = GainStore::open(file).value();
  ASSERT_EQ(old.active(), 1);
  EXPECT_EQ(old.slot(1)->gains.pd.kd_V_s_per_m, 2);
  EXPECT_EQ(old.slot(1)->gains.ki_V_per_m_s, 0);
}

TEST_F(GainFile, ADirectoryThatIsGoneIsAnErrorAndTheOldGainsStay) {
  auto store = GainStore::open(directory / "no" / "gains.txt").value();
  EXPECT_FALSE(store.store({60, 1, 50, false}));
  EXPECT_EQ(store.active(), 0);
}

TEST(GainChange, HappensBetweenTicksWithoutABump) {
  TestRig rig;
  // Half way up a step, at full speed and with a large error: the worst moment.
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) {
    s.set(wire::Id::experiment_kind, 1);
    s.set(wire::Id::step_pattern, 0);
  })));
  rig.ticks(1060);
  const double before_V = rig.last_row()[column::u];
  const double before_y = rig.last_row()[column::y];
  ASSERT_GT(std::abs(before_V), 1);
  ASSERT_TRUE(rig.command(wire::Command::activate_gains, {}, {20, 4, 50, false}));
  const LogRow after = rig.last_row();
  // With the old gains the voltage would move by Kp times what the cart moved in this tick, and no more.
  EXPECT_NEAR(after[column::u], before_V - 60 * (after[column::y] - before_y), 1e-9);
  EXPECT_NE(static_cast<unsigned>(after[column::status]) & wire::kStatusGainsChanged, 0U);
  // What keeps the voltage continuous is logged as added voltage, and goes away.
  EXPECT_GT(std::abs(after[column::d]), 0.1);
  rig.ticks(2000);
  EXPECT_LT(std::abs(rig.last_row()[column::d]), 1e-3);
  EXPECT_EQ(rig.status().gains.pd.kp_V_per_m, 20);
}

TEST(GainChange, ToAnIntegralPartTakesAwayWhatATiltLeavesAndBackAgainWithoutABump) {
  TestRig rig(Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::constant_acceleration, 1));
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) {
    s.set(wire::Id::experiment_kind, 6);  // hold
    s.set(wire::Id::experiment_duration_s, 30);
  })));
  const auto error_m = [&] { return rig.last_row()[column::r] - rig.last_row()[column::y]; };
  rig.ticks(5000);
  EXPECT_NEAR(error_m(), -1 / (1.9 * 60), 1e-4);
  const double held_V = rig.last_row()[column::u];
  ASSERT_TRUE(rig.command(wire::Command::activate_gains, {}, {{60, 2, 50, false}, 300}));
  EXPECT_NEAR(rig.last_row()[column::u], held_V, 0.02);  // but for a tick of the integral
  rig.ticks(8000);
  EXPECT_NEAR(error_m(), 0, 5e-5);
  EXPECT_NEAR(rig.last_row()[column::u], -1 / 1.9, 0.02);
  ASSERT_TRUE(rig.command(wire::Command::activate_gains, {}, {60, 2, 50, false}));
  EXPECT_NEAR(rig.last_row()[column::u], -1 / 1.9, 0.02);
  rig.ticks(6000);
  EXPECT_NEAR(error_m(), -1 / (1.9 * 60), 1e-4);
}

TEST(GainChange, DoesNotTouchARunWithGainsOfItsOwn) {
  TestRig rig;
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) {
    s.set(wire::Id::experiment_kind, 1);
    s.set(wire::Id::experiment_own_gains, 1);
  })));
  rig.ticks(1060);
  ASSERT_TRUE(rig.command(wire::Command::activate_gains, {}, {20, 4, 50, false}));
  EXPECT_EQ(rig.last_row()[column::d], 0);
}

}  // namespace
}  // namespace cartwright::firmware
