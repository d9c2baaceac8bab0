#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/e2e/process.hpp"

namespace cartwright::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using Words = std::vector<std::string>;

/// NLm3 of Wongvanich, Hann and Sirisena (2015), Eq. (78), with intervals.
constexpr const char* kCart =
    "[model]\nvoltage_gain_m_per_s2_V = 1.91\n[model.exponential_damping]\nalpha1_per_s = 15.2528\n"
    "alpha2_s_per_m = 5.9934\ngamma_per_s = 3.7990\n[intervals]\n\"voltage_gain_m_per_s2_V\" = [1.89, 1.93]\n"
    "\"exponential_damping.gamma_per_s\" = [3.6, 4.0]\n";

Finished design(const Scratch& scratch, Words more) {
  scratch.put("cart.toml", kCart);
  Words words{"design", "--model", scratch.text("cart.toml"), "--kp", "100"};
  words.insert(words.end(), more.begin(), more.end());
  return cartwright(words);
}

TEST(DesignCommand, ProposesAGainFileThatTheControllerTakes) {
  const Scratch scratch;
  const std::string file = scratch.text("gains.toml");
  const Finished made =
      design(scratch, {"--settling-time", "0.5", "--settling-band", "0.01", "--encoder", "2.275e-5", "--out",
                       file, "--report", scratch.text("design.html"), "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  const json found = json::parse(made.out);
  EXPECT_EQ(found["found"], true);
  EXPECT_EQ(found["gains"]["kp_V_per_m"], 100);
  const json& settled = found["prediction"]["settling_time_s"];
  EXPECT_LE(settled["low"], settled["value"]);
  EXPECT_LE(settled["value"], settled["high"]);
  EXPECT_LE(settled["high"], 0.5);
  EXPECT_GT(found["tuning_rules"].size(), 5u);
  EXPECT_GT(std::filesystem::file_size(scratch / "design.html"), 10000u);
  Daemon daemon;
  ASSERT_TRUE(daemon.ready());
  const Finished flashed = daemon.device({"gains", "flash", file});
  EXPECT_EQ(flashed.status, 0) << flashed.err;
  const json active = json::parse(daemon.device({"gains", "get", "--json"}).out)["controller"];
  EXPECT_NEAR(active["kd_V_s_per_m"], found["gains"]["kd_V_s_per_m"], 1e-5);
}

TEST(DesignCommand, ProposesPidGainsThatTheControllerRunsAndRecords) {
  const Scratch scratch;
  const std::string file = scratch.text("gains.toml");
  const Finished made = design(scratch, {"--law", "pid", "--kd", "8", "--settling-time", "1", "--overshoot",
                                         "0.2", "--out", file, "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  const double ki = json::parse(made.out)["gains"]["ki_V_per_m_s"];
  EXPECT_GT(ki, 0);
  Daemon daemon;
  ASSERT_TRUE(daemon.ready());
  ASSERT_EQ(daemon.device({"gains", "flash", file}).status, 0);
  const json active = json::parse(daemon.device({"gains", "get", "--json"}).out)["controller"];
  EXPECT_EQ(active["type"], "pid");
  EXPECT_NEAR(active["ki_V_per_m_s"], ki, 1e-4 * ki);
  const Finished ran = daemon.device({"run", "step", "--duration-s", "2", "--out", scratch.text("step")});
  ASSERT_EQ(ran.status, 0) << ran.err;
  std::ifstream toml(scratch / "step/session.toml");
  const std::string text((std::istreambuf_iterator<char>(toml)), {});
  EXPECT_THAT(text, HasSubstr("type = \"pid\", kp_V_per_m = 100"));
}

TEST(DesignCommand, FindsTheTwoIntervalsOfThePublishedModelWithTheIdealLaw) {
  const Scratch scratch;
  const Finished made =
      design(scratch, {"--ideal", "--settling-time", "0.5", "--settling-band", "0.01", "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  const json met = json::parse(made.out)["kd_that_meet_it_V_s_per_m"];
  ASSERT_GE(met.size(), 2u);
  EXPECT_NEAR(met[0][0], 3.8, 0.1);
  EXPECT_NEAR(met[0][1], 4.75, 0.1);
  EXPECT_NEAR(met[1][0], 7.5, 0.15);
}

TEST(DesignCommand, AnswersNoWhereNothingMeetsItAndWritesNoGains) {
  const Scratch scratch;
  const std::string file = scratch.text("gains.toml");
  const Finished made = design(scratch, {"--settling-time", "0.05", "--overshoot", "0.05", "--out", file});
  EXPECT_EQ(made.status, 1) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_THAT(made.out, HasSubstr("no gains meet the specification; nearest is Kp = 100"));
  EXPECT_THAT(made.out, HasSubstr("<- binds"));
  EXPECT_FALSE(std::filesystem::exists(file));
}

}  // namespace
}  // namespace cartwright::test
