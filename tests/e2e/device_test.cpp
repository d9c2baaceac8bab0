#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/device/controller.hpp"
#include "host/session/session.hpp"
#include "tests/e2e/process.hpp"

namespace cartwright::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

/// The model of Daemon's simulated cart.
constexpr const char* kTrueModel =
    "[model]\nvoltage_gain_m_per_s2_V = 1.9\n[model.viscous_friction]\ncoefficient_per_s = 5.0\n"
    "[model.coulomb_friction]\nlevel_m_per_s2 = 0.5\n";

class EndToEnd : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(daemon_.ready()); }
  json status() const { return json::parse(daemon_.device({"status", "--json"}).out, nullptr, false); }

  Daemon daemon_;
  Scratch scratch_;
};

TEST_F(EndToEnd, ABatteryComesOutAsASessionThatTheTrueModelPredicts) {
  EXPECT_EQ(status()["state"], "disarmed");
  const Finished ran = daemon_.device({"run", "battery", "--out", scratch_.text("session")});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(status()["state"], "disarmed");
  EXPECT_EQ(ran.err, "");

  const auto session = read_session(scratch_ / "session");
  ASSERT_TRUE(session) << session.error().message;
  ASSERT_THAT(session->recordings, SizeIs(10));
  EXPECT_EQ(session->rig.name, "test cart");
  EXPECT_EQ(session->rig.voltage_limit_V, 12);
  std::size_t repeats = 0, relays = 0;
  for (const Recording& recording : session->recordings) {
    EXPECT_GT(recording.size(), 1000u) << recording.file;
    EXPECT_EQ(recording.t_s.front(), 0) << recording.file;
    EXPECT_EQ(recording.r_m.size(), recording.size()) << recording.file;
    EXPECT_TRUE(recording.other_columns.contains("truth_y_m")) << recording.file;
    repeats += recording.repeat_of.empty() ? 0u : 1u;
    relays += recording.experiment == "relay" ? 1u : 0u;
  }
  EXPECT_EQ(repeats, 2u);
  EXPECT_EQ(relays, 2u);

  // What the controller did and what the host believes it did are the same, to within the encoder.
  scratch_.put("true.toml", kTrueModel);
  const Finished evaluated = cartwright({"evaluate", "--model", scratch_.text("true.toml"), "--session",
                                         scratch_.text("session"), "--out", scratch_.text("ev"), "--json"});
  ASSERT_EQ(evaluated.status, 0) << evaluated.err;
  EXPECT_LT(json::parse(evaluated.out)["window_rmse_m"].get<double>(), 2.275e-5);

  // And the truth comes out of the recordings.
  const Finished identified =
      cartwright({"identify", "--session", scratch_.text("session"), "--terms",
                  "viscous_friction,coulomb_friction", "--out", scratch_.text("model.toml"), "--json"});
  ASSERT_EQ(identified.status, 0) << identified.err;
  const json parameters = json::parse(identified.out)["parameters"];
  EXPECT_NEAR(parameters["voltage_gain_m_per_s2_V"]["value"].get<double>(), 1.9, 0.003 * 1.9);
  EXPECT_NEAR(parameters["viscous_friction.coefficient_per_s"]["value"].get<double>(), 5, 0.01 * 5);
  EXPECT_NEAR(parameters["coulomb_friction.level_m_per_s2"]["value"].get<double>(), 0.5, 0.02 * 0.5);

  for (const char* format : {"mat", "ulg"}) {
    const Finished exported = cartwright({"export", scratch_.text("session"), "--to", format});
    EXPECT_EQ(exported.status, 0) << exported.err;
  }
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "session/session.mat"));
}

TEST_F(EndToEnd, AStepTakesItsNumbersFromTheCommandLine) {
  const Finished ran = daemon_.device({"run", "step", "--amplitude-m", "0.05", "--pattern", "single",
                                       "--delay-s", "0.1", "--duration-s", "2", "--kp-V-per-m", "80",
                                       "--kd-V-s-per-m", "1.5", "--out", scratch_.text("step")});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto session = read_session(scratch_ / "step");
  ASSERT_TRUE(session) << session.error().message;
  ASSERT_THAT(session->recordings, SizeIs(1));
  const Recording& step = session->recordings[0];
  const auto* gains = std::get_if<PdGains>(&step.controller);
  ASSERT_NE(gains, nullptr);
  EXPECT_EQ(gains->kp_V_per_m, 80);
  EXPECT_EQ(gains->kd_V_s_per_m, 1.5);
  EXPECT_NEAR(static_cast<double>(step.size()), 2000, 1);
  EXPECT_NEAR(step.r_m.back() - step.r_m.front(), 0.05, 1e-6);
  // The first command after the jump of the reference is the law itself.
  std::size_t jump = 1;
  while (jump < step.size() && step.r_m[jump] == step.r_m[jump - 1]) ++jump;
  ASSERT_LT(jump, step.size());
  EXPECT_NEAR(step.t_s[jump], 0.1, 0.0015);
}

TEST_F(EndToEnd, PullFetchesWhatRunLeft) {
  EXPECT_EQ(daemon_.device({"pull", "--out", scratch_.text("none")}).status, 1);
  for (int i = 0; i < 2; ++i) ASSERT_EQ(daemon_.device({"run", "hold", "--duration-s", "1"}).status, 0);
  ASSERT_EQ(daemon_.device({"pull", "--out", scratch_.text("both")}).status, 0);
  ASSERT_EQ(daemon_.device({"pull", "--out", scratch_.text("one"), "--last", "1"}).status, 0);
  EXPECT_THAT(read_session(scratch_ / "both").value().recordings, SizeIs(2));
  EXPECT_THAT(read_session(scratch_ / "one").value().recordings, SizeIs(1));
}

TEST_F(EndToEnd, GainsGoRoundAndKeepTheirBounds) {
  scratch_.put("gains.toml", "[controller]\ntype = \"pd\"\nkp_V_per_m = 72.5\nkd_V_s_per_m = 0.75\n");
  const Finished flashed = daemon_.device({"gains", "flash", scratch_.text("gains.toml")});
  ASSERT_EQ(flashed.status, 0) << flashed.err;
  const json gains = json::parse(daemon_.device({"gains", "get", "--json"}).out);
  EXPECT_EQ(gains["controller"]["kp_V_per_m"], 72.5);
  EXPECT_EQ(gains["controller"]["kd_V_s_per_m"], 0.75);
  scratch_.put("again.toml", daemon_.device({"gains", "get"}).out);
  EXPECT_EQ(daemon_.device({"gains", "flash", scratch_.text("again.toml")}).status, 0);
  EXPECT_EQ(daemon_.device({"gains", "activate", "1"}).status, 0);

  scratch_.put("gains.toml", "[controller]\ntype = \"pd\"\nkp_V_per_m = 1e6\n");
  const Finished refused = daemon_.device({"gains", "flash", scratch_.text("gains.toml")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("gains.toml:3: kp_V_per_m"));
}

TEST_F(EndToEnd, AFaultIsToldKeptAndLeftOnlyByAReset) {
  // A weak hold and a strong slow push: the cart leaves its travel.
  const Finished ran = daemon_.device({"run", "dither", "--amplitude-V", "10", "--low-hz", "0.2", "--high-hz",
                                       "0.4", "--lines", "2", "--kp-V-per-m", "1", "--duration-s", "10",
                                       "--out", scratch_.text("fault")});
  EXPECT_EQ(ran.status, 1) << ran.out << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("fault"));
  EXPECT_EQ(status()["state"], "faulted");
  EXPECT_EQ(status()["fault"], "travel_limit");
  EXPECT_EQ(status()["log_frozen"], 1);
  // What was recorded up to the fault is there.
  const auto session = read_session(scratch_ / "fault");
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_GT(std::abs(session->recordings[0].y_m.back()), 0.38);

  const Finished armed = daemon_.device({"arm"});
  EXPECT_EQ(armed.status, 1);
  EXPECT_THAT(armed.err, StartsWith("cartwright: "));
  EXPECT_EQ(daemon_.device({"status"}).status, 0);
  EXPECT_EQ(daemon_.device({"reset"}).status, 0);
  EXPECT_EQ(status()["state"], "disarmed");
}

TEST_F(EndToEnd, OnlyOneClientCommands) {
  {
    auto owner = device::Controller::connect({"127.0.0.1", daemon_.port()});
    ASSERT_TRUE(owner) << owner.error().message;
    ASSERT_TRUE(owner->command(wire::Command::arm));
    const Finished second = daemon_.device({"disarm"});
    EXPECT_EQ(second.status, 1);
    EXPECT_THAT(second.err, HasSubstr("another client"));
    EXPECT_EQ(status()["state"], "armed");
    EXPECT_EQ(daemon_.device({"watch", "--once"}).status, 0);
  }
  EXPECT_EQ(daemon_.device({"disarm"}).status, 0);
}

TEST_F(EndToEnd, WatchGivesOneJsonObjectPerLine) {
  const Finished watched = daemon_.device({"watch", "--once", "--json"});
  ASSERT_EQ(watched.status, 0) << watched.err;
  const json line = json::parse(watched.out);
  EXPECT_EQ(line["state"], "disarmed");
  EXPECT_TRUE(line["position_m"].is_number());
}

TEST_F(EndToEnd, CompensationIsSwitchedShownAndRecorded) {
  scratch_.put("model.toml", std::string(kTrueModel) + "[model.transport_delay]\ndelay_s = 0.001\n");
  const Finished on = daemon_.device({"compensation", "adaptive", "--model", scratch_.text("model.toml"),
                                      "--set", "adaptive_kf1=3", "--json"});
  ASSERT_EQ(on.status, 0) << on.err;
  const json now = json::parse(on.out);
  EXPECT_EQ(now["mode"], "adaptive");
  EXPECT_EQ(now["ignored_terms"], json({"transport_delay"}));
  EXPECT_NEAR(now["estimates"]["f1_V"].get<double>(), 0.5 / 1.9, 1e-5);

  const std::vector<std::string> sine = {
      "run",          "track", "--shape",      "sine", "--low-hz",       "0.5", "--amplitude-m", "0.1",
      "--duration-s", "8",     "--kp-V-per-m", "80",   "--kd-V-s-per-m", "3",   "--out"};
  const auto error_m = [&](const std::string& name) {
    std::vector<std::string> words = sine;
    words.push_back(scratch_.text(name));
    const Finished ran = daemon_.device(words);
    EXPECT_EQ(ran.status, 0) << ran.err;
    const auto session = read_session(scratch_ / name);
    if (!session) return std::nan("");
    const Recording& recording = session->recordings[0];
    double sum = 0;
    for (std::size_t row = 0; row < recording.size(); ++row)
      sum += std::pow(recording.r_m[row] - recording.y_m[row], 2);
    EXPECT_EQ(recording.other_columns.contains("estimate_f1_V"), name == "with");
    return std::sqrt(sum / static_cast<double>(recording.size()));
  };
  const double with_m = error_m("with");
  ASSERT_EQ(daemon_.device({"compensation", "off"}).status, 0);
  EXPECT_GT(error_m("without") / with_m, 11);
  for (const char* format : {"mat", "ulg"}) {
    EXPECT_EQ(cartwright({"export", scratch_.text("with"), "--to", format}).status, 0);
  }
  EXPECT_EQ(json::parse(daemon_.device({"compensation", "--json"}).out)["mode"], "off");
}

TEST_F(EndToEnd, WatchShowsWhatIsIdentifiedWhileTheRigRuns) {
  const json before = json::parse(daemon_.device({"watch", "--once", "--json"}).out);
  EXPECT_TRUE(before["identified"]["voltage_gain_m_per_s2_V"]["value"].is_null());
  for (int i = 0; i < 2; ++i) ASSERT_EQ(daemon_.device({"run", "track", "--duration-s", "20"}).status, 0);
  const json after = json::parse(daemon_.device({"watch", "--once", "--json"}).out);
  const json& gain = after["identified"]["voltage_gain_m_per_s2_V"];
  EXPECT_NEAR(gain["value"].get<double>(), 1.9, 0.01 * 1.9);
  EXPECT_LT(gain["low"].get<double>(), gain["high"].get<double>());
  EXPECT_EQ(after["notice"], "none");
  // A model that is far from the rig is noticed, in words.
  scratch_.put("far.toml", "[model]\nvoltage_gain_m_per_s2_V = 1.5\n");
  ASSERT_EQ(daemon_.device({"compensation", "--model", scratch_.text("far.toml")}).status, 0);
  ASSERT_EQ(daemon_.device({"run", "track", "--duration-s", "20"}).status, 0);
  EXPECT_THAT(daemon_.device({"watch", "--once"}).out, HasSubstr("stopped matching the model"));
  EXPECT_THAT(daemon_.device({"status"}).out, HasSubstr("notice"));
  ASSERT_EQ(daemon_.device({"relearn"}).status, 0);
  EXPECT_EQ(json::parse(daemon_.device({"watch", "--once", "--json"}).out)["notice"], "none");
}

TEST_F(EndToEnd, CompensationSaysWhatIsWrongWithWhatItIsGiven) {
  const Finished without_model = daemon_.device({"compensation", "feedforward"});
  EXPECT_EQ(without_model.status, 1);
  EXPECT_THAT(without_model.err, HasSubstr("needs a model"));
  for (const std::string set : {"adaptive_kf1=-1", "adaptive_kf1=x", "adaptive_kf1", "relay_h1_V=1"}) {
    const Finished refused = daemon_.device({"compensation", "--set", set});
    EXPECT_EQ(refused.status, 2) << set;
    EXPECT_THAT(refused.err, HasSubstr("--set " + set));
    EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
  }
  EXPECT_EQ(daemon_.device({"compensation", "sideways"}).status, 2);
  EXPECT_EQ(daemon_.device({"compensation", "--model", scratch_.text("none.toml")}).status, 2);
}

TEST_F(EndToEnd, ARefusedRunSaysWhyAndLeavesTheControllerDisarmed) {
  const Finished ran = daemon_.device({"run", "step", "--amplitude-m", "1.5"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_THAT(ran.err, HasSubstr("travel"));
  EXPECT_EQ(status()["state"], "disarmed");
}

TEST_F(EndToEnd, TheDaemonEndsCleanly) {
  EXPECT_EQ(daemon_.stop(), 0);
}

/// A port that is taken but on which nobody listens.
class DeadPort {
 public:
  DeadPort() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    ::bind(socket_, reinterpret_cast<sockaddr*>(&address), size);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  ~DeadPort() { ::close(socket_); }
  std::string port() const { return std::to_string(port_); }

 private:
  int socket_;
  int port_ = 0;
};

TEST(Unreachable, EveryDeviceCommandSaysWhereNobodyAnswers) {
  const DeadPort dead;
  const Scratch scratch;
  scratch.put("gains.toml", "[controller]\ntype = \"pd\"\nkp_V_per_m = 60\n");
  const std::vector<std::vector<std::string>> commands = {
      {"status"},
      {"arm"},
      {"disarm"},
      {"stop"},
      {"reset"},
      {"run", "battery", "--out", scratch.text("out")},
      {"gains", "get"},
      {"gains", "flash", scratch.text("gains.toml")},
      {"gains", "activate", "1"},
      {"pull", "--out", scratch.text("out")},
      {"watch", "--once"},
      {"compensation", "off"},
      {"relearn"},
  };
  for (std::vector<std::string> command : commands) {
    SCOPED_TRACE(command[0]);
    command.insert(command.begin(), "device");
    command.insert(command.end(), {"--port", dead.port()});
    const Finished finished = cartwright(command);
    EXPECT_EQ(finished.status, 2);
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr("127.0.0.1:" + dead.port()));
    EXPECT_EQ(finished.out, "");
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
  }
}

TEST(Once, ARelayTestThatDoesNotConvergeIsWrittenAndTold) {
  const Scratch scratch;
  scratch.put("rig.toml",
              "[rig]\nkind = \"simulated\"\nsample_rate_hz = 1000\nencoder_resolution_m = "
              "2e-5\n[simulation]\nmodel = \"cart.toml\"\n");
  scratch.put("cart.toml", kTrueModel);
  // Too little to break friction: nothing swings.
  const auto relay = [&](const char* volts) {
    return run(CARTWRIGHTD_PROGRAM,
               {"--rig", scratch.text("rig.toml"), "--virtual", "--once", "relay", "--set",
                std::string("relay_h1_V=") + volts, "--set", "relay_h2_V=0", "--out", scratch.text(volts)});
  };
  const Finished weak = relay("0.2"), strong = relay("2");
  EXPECT_EQ(weak.status, 1) << weak.err;
  EXPECT_THAT(weak.err, HasSubstr("without a converged limit cycle"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "0.2" / "session.toml"));
  EXPECT_EQ(strong.status, 0) << strong.err;
}

TEST(Unreachable, ANameThatNoMachineHasIsSaid) {
  const Finished finished = cartwright({"device", "status", "--host", "no machine"});
  EXPECT_EQ(finished.status, 2);
  EXPECT_THAT(finished.err, HasSubstr("--host no machine: no machine of that name"));
}

}  // namespace
}  // namespace cartwright::test
