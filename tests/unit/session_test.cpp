#include "host/session/session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace cartwright {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kRig = "[rig]\nsample_rate_hz = 1000\n";
constexpr const char* kRows = "t_s,r_m,y_m,u_V\n0,0,0,0\n0.001,0.1,0,6\n0.002,0.1,1e-5,5.9\n";

class SessionFiles : public testing::Test {
 protected:
  SessionFiles()
      : directory_(fs::temp_directory_path() / ("cartwright-session-" + std::to_string(::getpid()))) {
    fs::create_directories(directory_);
  }
  ~SessionFiles() override { fs::remove_all(directory_); }

  void put(const std::string& name, const std::string& text) { std::ofstream(directory_ / name) << text; }

  std::string refusal(const std::string& toml, const std::string& csv = kRows) {
    put("session.toml", toml);
    put("a.csv", csv);
    const auto session = read_session(directory_);
    return session ? "accepted" : session.error().message;
  }

  fs::path directory_;
};

TEST_F(SessionFiles, ReadsWhatItWrites) {
  Session session;
  session.rig.name = "the \"red\" cart";
  session.rig.encoder_resolution_m = 2.275e-5;
  session.rig.travel_m = {-0.3, 0.35};
  Recording pd;
  pd.file = "a.csv";
  pd.experiment = "step";
  pd.controller = PdGains{60, 1.5, 40, true};
  pd.t_s = {0, 0.001, 0.0021};
  pd.y_m = {0, 1e-5, 2e-5};
  pd.u_V = {6, 5.9, -12};
  pd.r_m = {0.1, 0.1, 0.1};
  pd.d_V = {0, 0.5, 0};
  pd.other_columns["i_A"] = {0.1, NAN, 0.3};
  Recording relay = pd;
  relay.file = "b.csv";
  relay.repeat_of = "a.csv";
  relay.controller = DualRelayGains{2, 1.5, 1e-4};
  Recording foreign = pd;
  foreign.file = "c.csv";
  foreign.controller = {};
  foreign.r_m.clear();
  session.recordings = {pd, relay, foreign};
  ASSERT_TRUE(write_session(session, directory_ / "out").has_value());
  const auto again = read_session(directory_ / "out");
  ASSERT_TRUE(again.has_value()) << again.error().message;
  EXPECT_EQ(again->rig.name, session.rig.name);
  EXPECT_EQ(again->rig.encoder_resolution_m, session.rig.encoder_resolution_m);
  EXPECT_EQ(again->rig.travel_m, session.rig.travel_m);
  ASSERT_EQ(again->recordings.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Recording &a = session.recordings[i], &b = again->recordings[i];
    EXPECT_EQ(a.file, b.file);
    EXPECT_EQ(a.repeat_of, b.repeat_of);
    EXPECT_EQ(a.t_s, b.t_s);
    EXPECT_EQ(a.y_m, b.y_m);
    EXPECT_EQ(a.u_V, b.u_V);
    EXPECT_EQ(a.r_m, b.r_m);
    EXPECT_EQ(a.d_V, b.d_V);
    EXPECT_TRUE(std::isnan(b.other_columns.at("i_A")[1]));
    EXPECT_EQ(a.controller.index(), b.controller.index());
  }
  EXPECT_EQ(std::get<PdGains>(again->recordings[0].controller).derivative_filter_hz, 40);
  EXPECT_TRUE(std::get<PdGains>(again->recordings[0].controller).derivative_on_measurement);
  EXPECT_EQ(std::get<DualRelayGains>(again->recordings[1].controller).hysteresis_m, 1e-4);
}

TEST_F(SessionFiles, KeepsColumnsItDoesNotKnowInAnyOrder) {
  put("session.toml", std::string(kRig) + "[[recording]]\nfile = 'a.csv'\n");
  put("a.csv", "wind,u_V,t_s,y_m\n7,1,0,0.1\n8,2,1,0.2\n");
  const auto session = read_session(directory_);
  ASSERT_TRUE(session.has_value()) << session.error().message;
  EXPECT_EQ(session->recordings[0].other_columns.at("wind"), (std::vector<double>{7, 8}));
  EXPECT_EQ(session->recordings[0].u_V, (std::vector<double>{1, 2}));
  EXPECT_FALSE(session->recordings[0].has_controller());
}

TEST_F(SessionFiles, RefusesUnusableRows) {
  const std::string toml = std::string(kRig) + "[[recording]]\nfile = 'a.csv'\n";
  EXPECT_THAT(refusal(toml, "t_s,y_m\n0,1\n1,2\n"), HasSubstr("no column u_V"));
  EXPECT_THAT(refusal(toml, "t_s,y_m,u_V\n0,1,2\n1,,2\n"), HasSubstr("a.csv:3: y_m is missing"));
  EXPECT_THAT(refusal(toml, "t_s,y_m,u_V\n0,1,2\n1,nan,2\n"), HasSubstr("a.csv:3: y_m"));
  EXPECT_THAT(refusal(toml, "t_s,y_m,u_V\n0,1,2\n1,inf,2\n"), HasSubstr("infinite"));
  EXPECT_THAT(refusal(toml, "t_s,y_m,u_V\n0,1,2\n2,1,2\n1,1,2\n"),
              HasSubstr("a.csv:4: t_s goes from 2 to 1"));
  EXPECT_THAT(refusal(toml, "t_s,y_m,u_V\n0,1,2\n0,1,2\n"), HasSubstr("must increase"));
  EXPECT_THAT(refusal(toml, "t_s,y_m,u_V\n0,1,2\n"), HasSubstr("at least 2"));
  EXPECT_THAT(refusal(toml, "t_s,y_m,u_V\n"), HasSubstr("at least 2"));
}

TEST_F(SessionFiles, RefusesContradictorySessions) {
  const std::string rig = kRig, one = "[[recording]]\nfile = 'a.csv'\n";
  EXPECT_THAT(refusal(one), HasSubstr("no [rig]"));
  EXPECT_THAT(refusal("[rig]\n" + one), HasSubstr("sample_rate_hz is missing"));
  EXPECT_THAT(refusal("[rig]\nsample_rate_hz = 0\n" + one), HasSubstr("session.toml:2"));
  EXPECT_THAT(refusal("[rig]\nsample_rate_hz = 1000\ntravel_m = [0.4, -0.4]\n" + one), HasSubstr("travel_m"));
  EXPECT_THAT(refusal(rig), HasSubstr("no [[recording]]"));
  EXPECT_THAT(refusal(rig + one + one), HasSubstr("listed twice"));
  EXPECT_THAT(refusal(rig + "[[recording]]\nexperiment = 'step'\n"), HasSubstr("file is missing"));
  EXPECT_THAT(refusal(rig + "[[recording]]\nfile = '../a.csv'\n"), HasSubstr("beside session.toml"));
  EXPECT_THAT(refusal(rig + one + "repeat_of = 'z.csv'\n"), HasSubstr("names no recording"));
  EXPECT_THAT(refusal(rig + one + "controller = { type = 'lqr' }\n"), HasSubstr("type \"lqr\" is unknown"));
  EXPECT_THAT(refusal(rig + one + "controller = { type = 'pd' }\n"), HasSubstr("kp_V_per_m is missing"));
  EXPECT_THAT(refusal(rig + one + "controller = { type = 'pd', kp_V_per_m = 60, ki = 1 }\n"),
              HasSubstr("unknown key ki"));
  EXPECT_THAT(
      refusal(rig + one + "controller = { type = 'pd', kp_V_per_m = 60 }\n", "t_s,y_m,u_V\n0,1,2\n1,1,2\n"),
      HasSubstr("no column r_m"));
  EXPECT_THAT(refusal(rig + "[[recording]]\nfile = 'gone.csv'\n"), HasSubstr("gone.csv"));
  EXPECT_THAT(refusal("[rig\n"), HasSubstr("session.toml:1"));
}

TEST_F(SessionFiles, AFullOrForbiddenDiskLeavesNothingHalfWritten) {
  // A directory in the place of the file to write: nothing can be renamed over it, whoever runs this.
  fs::create_directories(directory_ / "out" / "session.toml" / "in the way");
  Session session;
  Recording recording;
  recording.file = "a.csv";
  recording.t_s = {0, 1};
  recording.y_m = recording.u_V = {0, 0};
  session.recordings = {recording};
  const auto written = write_session(session, directory_ / "out");
  ASSERT_FALSE(written.has_value());
  EXPECT_THAT(written.error().message, HasSubstr("session.toml"));
  for (const auto& entry : fs::directory_iterator(directory_ / "out")) {
    EXPECT_EQ(entry.path().filename().string().find(".part"), std::string::npos) << entry.path();
  }
}

}  // namespace
}  // namespace cartwright
