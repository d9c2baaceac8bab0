#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <tuple>

#include "common/files/files.hpp"
#include "firmware/compensation_setup.hpp"
#include "firmware/daemon.hpp"
#include "firmware/rig_file.hpp"

namespace cartwright::firmware {
namespace {

const std::string kGood =
    "[rig]\nkind = \"simulated\"\nsample_rate_hz = 1000\nencoder_resolution_m = 1e-5\ntravel_m = [-0.3, "
    "0.4]\n"
    "clock = \"virtual\"\nport = 0\ngain_file = \"g.txt\"\n"
    "[simulation]\nseed = 7\nstart_position_m = 0.1\n"
    "[model]\nvoltage_gain_m_per_s2_V = 2.5\n";

TEST(RigFile, ReadsWhatItSays) {
  const auto rig = rig_file_from_toml(kGood, "dir/rig.toml");
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_TRUE(rig->virtual_time);
  EXPECT_EQ(rig->port, 0);
  EXPECT_EQ(rig->rig.travel_m[0], -0.3);
  EXPECT_EQ(rig->gain_file, std::filesystem::path("dir/g.txt"));
  EXPECT_EQ(rig->seed, 7U);
  EXPECT_EQ(rig->model[Parameter::voltage_gain], 2.5);
}

TEST(RigFile, TakesTheCompensationAndItsModelWithWhatCannotBeInvertedLeftOut) {
  const auto directory =
      std::filesystem::temp_directory_path() / ("cartwright-rig-" + std::to_string(::getpid()));
  std::filesystem::create_directories(directory);
  ASSERT_TRUE(write_file(directory / "found.toml",
                         "[model]\nvoltage_gain_m_per_s2_V = 1.8\n[model.coulomb_friction]\nlevel_m_per_s2 = "
                         "0.4\n[model.transport_delay]\ndelay_s = 0.002\n"));
  const auto rig = rig_file_from_toml(
      kGood + "[compensation]\nmode = \"adaptive\"\nmodel = \"found.toml\"\nadaptive_kf1 = 7\n",
      directory / "rig.toml");
  std::filesystem::remove_all(directory);
  ASSERT_TRUE(rig) << rig.error().message;
  EXPECT_EQ(rig->settings[wire::Id::compensation_mode], 2);
  EXPECT_EQ(rig->settings[wire::Id::model_voltage_gain_m_per_s2_V], 1.8);
  EXPECT_EQ(rig->settings[wire::Id::adaptive_kf1], 7);
  const auto setup = compensation_from(rig->settings, *rig);
  ASSERT_TRUE(setup);
  EXPECT_EQ(setup->model.coulomb, 0.4);
  EXPECT_EQ(setup->model.delay, 0);
  EXPECT_EQ(setup->law.mode, CompensationMode::adaptive);
}

/// What is replaced, by what, and a part of the message that must come.
class BadRigFile : public testing::TestWithParam<std::tuple<std::string, std::string, std::string>> {};

TEST_P(BadRigFile, IsRefusedWithItsLineAndWhatWouldBeRight) {
  const auto& [what, by, message] = GetParam();
  std::string text = kGood;
  text.replace(text.find(what), what.size(), by);
  const auto rig = rig_file_from_toml(text, "rig.toml");
  ASSERT_FALSE(rig);
  EXPECT_NE(rig.error().message.find(message), std::string::npos) << rig.error().message;
  EXPECT_EQ(rig.error().message.find("rig.toml"), 0U) << rig.error().message;
  EXPECT_EQ(rig.error().message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadRigFile,
    testing::Values(
        std::tuple("kind = \"simulated\"", "kind = \"linux\"", "rig.toml:2: kind = \"linux\""),
        std::tuple("kind = \"simulated\"\n", "", "kind is missing"),
        std::tuple("sample_rate_hz = 1000", "sample_rate_hz = 50", "outside [100, 4000]"),
        std::tuple("encoder_resolution_m = 1e-5\n", "", "encoder_resolution_m must be greater than 0"),
        std::tuple("clock = \"virtual\"", "clock = \"slow\"", "\"real\" or \"virtual\""),
        std::tuple("port = 0", "port = 99999", "outside [0, 65535]"),
        std::tuple("port = 0", "ports = 0", "unknown key ports"),
        std::tuple("port = 0", "travel_margin_m = 0.5", "leaves nothing"),
        std::tuple("[simulation]", "[compensation]\nmode = \"on\"\n[simulation]",
                   "\"feedforward\" or \"adaptive\""),
        std::tuple("[simulation]", "[compensation]\nmode = \"adaptive\"\n[simulation]", "needs model"),
        std::tuple("[simulation]", "[compensation]\nadaptive_kq = 1\n[simulation]",
                   "rig.toml:10: unknown key adaptive_kq"),
        std::tuple("[simulation]", "[compensation]\nadaptive_kf1 = -1\n[simulation]", "adaptive_kf1"),
        std::tuple("seed = 7", "model = \"cart.toml\"", "not both"),
        std::tuple("start_position_m = 0.1", "start_position_m = 0.9", "outside [-0.3, 0.4]"),
        std::tuple("[model]", "[rig]", "rig"), std::tuple("[model]", "[modell]", "unknown key modell")));

class Program : public testing::Test {
 protected:
  void SetUp() override {
    directory = std::filesystem::temp_directory_path() / ("cartwright-program-" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory);
    ASSERT_TRUE(write_file(directory / "rig.toml", kGood));
    options.rig_file = (directory / "rig.toml").string();
  }
  void TearDown() override { std::filesystem::remove_all(directory); }
  std::filesystem::path directory;
  Options options;
};

TEST_F(Program, TheCommandLineOverridesTheRigFile) {
  options.port = 1234;
  const auto rig = load_rig(options);
  ASSERT_TRUE(rig);
  EXPECT_EQ(rig->port, 1234);
  options.rig_file.clear();
  EXPECT_FALSE(load_rig(options));
}

}  // namespace
}  // namespace cartwright::firmware
