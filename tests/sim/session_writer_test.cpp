#include "firmware/session_writer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "host/evaluate/closed_loop.hpp"
#include "host/session/session.hpp"
#include "tests/sim/rig.hpp"

namespace cartwright::firmware {
namespace {

class WrittenSession : public testing::Test {
 protected:
  void SetUp() override {
    directory = std::filesystem::temp_directory_path() / ("cartwright-written-" + std::to_string(::getpid()));
  }
  void TearDown() override { std::filesystem::remove_all(directory); }
  std::filesystem::path directory;
};

TEST_F(WrittenSession, IsReadByTheHostAndItsSimulationRepeatsWhatTheControllerDid) {
  const RigFile file;
  TestRig rig(cart(), file, 150'000);
  ASSERT_TRUE(rig.start(battery(rig.rig)));
  ASSERT_TRUE(rig.finish());
  ASSERT_TRUE(write_session(rig.rig, *rig.exchange, directory));
  const auto session = read_session(directory);
  ASSERT_TRUE(session) << session.error().message;
  ASSERT_EQ(session->recordings.size(), 10U);
  EXPECT_EQ(session->recordings[4].repeat_of, "step_kp60_1.csv");
  for (const Recording& recording : session->recordings) {
    EXPECT_EQ(recording.t_s.front(), 0);
    EXPECT_NEAR(recording.t_s.back(), 1e-3 * static_cast<double>(recording.size() - 1), 1e-9);
    EXPECT_EQ(recording.other_columns.count("i_A"), 0U) << "a column without a number is left out";
    // Limit cycles magnify the rounding of the start position; everything else repeats to within it.
    if (recording.experiment == "relay") continue;
    const Recording again = simulate(cart(), session->rig, recording);
    double sum = 0;
    for (std::size_t i = 0; i < again.size(); ++i) sum += std::pow(again.y_m[i] - recording.y_m[i], 2);
    EXPECT_LT(std::sqrt(sum / static_cast<double>(again.size())), 2.275e-5) << recording.file;
  }
}

TEST_F(WrittenSession, IsNotWrittenWhenTheRingHasLostItsRows) {
  const RigFile file;
  TestRig rig(cart(), file, 1000);
  ASSERT_TRUE(rig.start(rig.one([](Settings& s) { s.set(wire::Id::experiment_kind, 1); })));
  ASSERT_TRUE(rig.finish());
  const auto written = write_session(rig.rig, *rig.exchange, directory);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("step.csv: 6000 rows"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(directory));
}

}  // namespace
}  // namespace cartwright::firmware
