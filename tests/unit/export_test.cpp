#include <gmock/gmock.h>
#include <matio.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "host/export/identifier.hpp"
#include "host/export/matlab.hpp"
#include "host/export/ulog.hpp"
#include "host/session/files.hpp"
#include "host/session/gaps.hpp"
#include "tests/unit/ulog_reader.hpp"

namespace cartwright {
namespace {

using test::UlogFile;
using testing::ElementsAre;
using testing::SizeIs;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// 100 ticks at 1 kHz, then 70.25 s lost, then 100 more.
Recording sample() {
  Recording recording;
  recording.file = "step-1.csv";
  recording.experiment = "step";
  recording.controller = PdGains{60, 0.5, 50, true};
  for (int tick = 0; tick < 200; ++tick) {
    recording.t_s.push_back(0.25 + tick * 1e-3 + (tick < 100 ? 0 : 70.25));
    recording.y_m.push_back(std::sin(0.1 * tick));
    recording.u_V.push_back(tick / 7.0);
    recording.r_m.push_back(0.1);
    recording.other_columns["motor C"].push_back(tick == 3 ? kNone : 20 + tick);
  }
  return recording;
}

TEST(Gaps, AreWhereRowsAreMissingAndNotWhereTimeJitters) {
  EXPECT_THAT(find_gaps({0, 0.00104, 0.00196, 0.00309}), SizeIs(0));
  const auto gaps = find_gaps({0, 0.001, 0.002, 0.0061, 0.007});
  ASSERT_THAT(gaps, SizeIs(1));
  EXPECT_EQ(gaps[0].row, 3u);
  EXPECT_EQ(gaps[0].lost_ticks, 3);
}

TEST(Identifiers, AreValidUniqueAndShort) {
  EXPECT_THAT(identifiers({"y_m", "motor C", "motor-C", "2nd", "", "y_m"}),
              ElementsAre("y_m", "motor_C", "motor_C_2", "x_2nd", "x_", "y_m_2"));
  const auto cut = identifiers({std::string(80, 'a'), std::string(80, 'a')});
  EXPECT_THAT(cut, ElementsAre(SizeIs(kMatlabNameLength), SizeIs(kMatlabNameLength)));
  EXPECT_NE(cut[0], cut[1]);
}

TEST(Ulog, HoldsEveryRowAndTheGains) {
  const Recording recording = sample();
  const auto bytes = to_ulog(Rig{}, recording);
  ASSERT_TRUE(bytes);
  UlogFile log(*bytes);
  ASSERT_TRUE(log.valid);
  EXPECT_EQ(log.first_types, "B");
  EXPECT_EQ(log.start_us, 250000u);
  EXPECT_EQ(log.info["experiment"], "step");
  EXPECT_EQ(log.info["controller_type"], "pd");
  EXPECT_EQ(log.parameters["kp_V_per_m"], 60.0f);

  const auto& ticks = log.topics["tick"];
  EXPECT_THAT(ticks.fields, ElementsAre("uint64_t timestamp", "double t_s", "double r_m", "double y_m",
                                        "double u_V", "double motor_C"));
  ASSERT_THAT(ticks.rows, SizeIs(recording.size()));
  for (std::size_t row = 0; row < recording.size(); ++row) {
    EXPECT_EQ(ticks.rows[row][0], recording.t_s[row]);
    EXPECT_EQ(ticks.rows[row][2], recording.y_m[row]);
    EXPECT_EQ(ticks.rows[row][3], recording.u_V[row]);
    EXPECT_NEAR(static_cast<double>(ticks.timestamps_us[row]) * 1e-6, recording.t_s[row], 0.5e-6);
  }
  EXPECT_TRUE(std::isnan(ticks.rows[3][4]));

  const auto& gains = log.topics["gains"];
  ASSERT_THAT(gains.rows, SizeIs(2));
  EXPECT_THAT(gains.rows[0], ElementsAre(60, 0.5, 50, 1));
  EXPECT_EQ(gains.timestamps_us.back(), ticks.timestamps_us.back());
}

TEST(Ulog, RecordsLossesWhereTheyAreAndAsLongAsTheyAre) {
  const UlogFile log(to_ulog(Rig{}, sample()).value());
  ASSERT_THAT(log.dropouts, SizeIs(2));  // one message holds at most 65.535 s
  EXPECT_EQ(log.dropouts[0].ticks_before, 100u);
  EXPECT_EQ(log.dropouts[0].milliseconds + log.dropouts[1].milliseconds, 70250u);
  EXPECT_THAT(log.messages, ElementsAre(testing::HasSubstr("70250 ticks lost")));
}

TEST(Ulog, ReadsUpToTheCutWhereverItIs) {
  const std::string whole = to_ulog(Rig{}, sample()).value();
  std::size_t rows_before = 0;
  for (std::size_t size = 0; size <= whole.size(); size += 13) {
    UlogFile log(std::string_view(whole).substr(0, size));
    if (size < 16) continue;
    ASSERT_TRUE(log.valid) << size;
    const std::size_t rows = log.topics["tick"].rows.size();
    EXPECT_GE(rows, rows_before);
    EXPECT_LE(rows, rows_before + 1);
    rows_before = rows;
  }
  EXPECT_GE(rows_before, sample().size() - 1);
}

TEST(Ulog, CountsTimeFromTheFirstRowWhereTimeIsNegative) {
  Recording recording = sample();
  for (double& time : recording.t_s) time -= 10;
  UlogFile log(to_ulog(Rig{}, recording).value());
  EXPECT_EQ(log.start_us, 0u);
  EXPECT_EQ(log.topics["tick"].timestamps_us[1], 1000u);
  EXPECT_EQ(log.topics["tick"].rows[0][0], recording.t_s[0]);
}

TEST(Ulog, RefusesTimesAndTablesThatDoNotFit) {
  Recording endless = sample();
  endless.t_s.back() = 1e15;
  EXPECT_FALSE(to_ulog(Rig{}, endless));
  Recording wide = sample();
  for (int i = 0; i < 9000; ++i) wide.other_columns["c" + std::to_string(i)].resize(wide.size());
  EXPECT_FALSE(to_ulog(Rig{}, wide));
}

class ExportedFile : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() /
                 ("cartwright_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) +
                  std::to_string(::getpid()));
    std::filesystem::create_directories(directory_);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }
  std::filesystem::path directory_;
};

TEST_F(ExportedFile, MatlabHoldsTheSession) {
  Session session;
  session.recordings = {sample(), sample()};
  session.recordings[1].file = "free run.csv";
  session.recordings[1].controller = {};
  const auto bytes = to_matlab(session);
  ASSERT_TRUE(bytes);
  EXPECT_THAT(*bytes, testing::StartsWith("MATLAB 5.0"));
  ASSERT_TRUE(write_file(directory_ / "session.mat", *bytes));

  mat_t* file = Mat_Open((directory_ / "session.mat").c_str(), MAT_ACC_RDONLY);
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(Mat_GetVersion(file), MAT_FT_MAT5);
  matvar_t* recording = Mat_VarRead(file, "step_1");
  ASSERT_NE(recording, nullptr);
  const auto field = [&](const char* name) { return Mat_VarGetStructFieldByName(recording, name, 0); };
  ASSERT_NE(field("y_m"), nullptr);
  EXPECT_EQ(field("y_m")->dims[0], 200u);
  EXPECT_EQ(field("y_m")->dims[1], 1u);
  for (std::size_t row = 0; row < 200; ++row) {
    EXPECT_EQ(static_cast<const double*>(field("y_m")->data)[row], sample().y_m[row]);
  }
  EXPECT_TRUE(std::isnan(static_cast<const double*>(field("motor_C")->data)[3]));
  EXPECT_EQ(field("losses_s")->dims[0], 1u);
  EXPECT_DOUBLE_EQ(static_cast<const double*>(field("losses_s")->data)[0], 0.349);
  matvar_t* gains = field("controller");
  EXPECT_EQ(*static_cast<const double*>(Mat_VarGetStructFieldByName(gains, "kp_V_per_m", 0)->data), 60.0);
  Mat_VarFree(recording);

  matvar_t* free_run = Mat_VarRead(file, "free_run");
  ASSERT_NE(free_run, nullptr);
  EXPECT_EQ(Mat_VarGetStructFieldByName(free_run, "controller", 0)->nbytes, 0u);
  Mat_VarFree(free_run);
  Mat_Close(file);
}

}  // namespace
}  // namespace cartwright
