#include <gmock/gmock.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <functional>
#include <string_view>

#include "tests/e2e/process.hpp"

#include "tests/small_disk.hpp"

namespace cartwright::test {
namespace {

using Words = std::vector<std::string>;

constexpr const char* kRig =
    "[rig]\nname = \"cart\"\nsample_rate_hz = 1000\nencoder_resolution_m = 2.275e-5\nvoltage_limit_V = 12.0\n"
    "travel_m = [-0.4, 0.4]\n";
constexpr const char* kRecording =
    "\n[[recording]]\nfile = \"step.csv\"\nexperiment = \"step\"\n"
    "controller = { type = \"pd\", kp_V_per_m = 60, kd_V_s_per_m = 0 }\n";
constexpr const char* kModel =
    "[model]\nvoltage_gain_m_per_s2_V = 1.9\n[model.viscous_friction]\ncoefficient_per_s = 5.0\n";

/// A step response long enough for every command; `row` may replace a line.
std::string csv(const std::string& header = "t_s,r_m,y_m,u_V",
                const std::function<std::string(int, const std::string&)>& row = {}) {
  std::string text = header + "\n";
  double y = 0, v = 0;
  for (int tick = 0; tick < 1500; ++tick) {
    const double u = std::clamp(60 * (0.1 - y), -12.0, 12.0);
    const std::string line =
        std::to_string(tick * 1e-3) + ",0.1," + std::to_string(y) + "," + std::to_string(u);
    text += (row ? row(tick, line) : line) + "\n";
    v += 1e-3 * (1.9 * u - 5 * v);
    y += 1e-3 * v;
  }
  return text;
}

struct BadSession {
  const char* what;
  std::string toml, recording;  ///< an empty one is not there
};

std::vector<BadSession> bad_sessions() {
  const std::string good = std::string(kRig) + kRecording;
  const auto at_700 = [](const std::string& instead) {
    return csv("t_s,r_m,y_m,u_V",
               [instead](int tick, const std::string& line) { return tick == 700 ? instead : line; });
  };
  const std::string whole = csv();
  return {
      {"no session.toml", "", csv()},
      {"no recording file", good, ""},
      {"no position column", good, csv("t_s,r_m,q_m,u_V")},
      {"two columns of one name", good, csv("t_s,r_m,y_m,y_m")},
      {"a NaN", good, at_700("0.7,0.1,nan,0")},
      {"an infinite voltage", good, at_700("0.7,0.1,0,inf")},
      {"an empty cell where a number is required", good, at_700("0.7,0.1,,0")},
      {"a word in the place of a number", good, at_700("0.7,0.1,broken,0")},
      {"time going backwards", good, at_700("0.3,0.1,0,0")},
      {"time standing still", good, at_700("0.699,0.1,0,0")},
      {"a row cut short", good, whole.substr(0, whole.rfind(','))},
      {"a header and nothing else", good, "t_s,r_m,y_m,u_V\n"},
      {"an empty file", good, "\n"},
      {"no rig", kRecording, csv()},
      {"travel the wrong way round",
       "[rig]\nsample_rate_hz = 1000\ntravel_m = [1, -1]\n" + std::string(kRecording), csv()},
      {"a negative rate", "[rig]\nsample_rate_hz = -1\n" + std::string(kRecording), csv()},
      {"a rate that the time stamps contradict", "[rig]\nsample_rate_hz = 500\n" + std::string(kRecording),
       csv()},
      {"an encoder in another unit",
       std::string(kRig) + "encoder_resolution_mm = 0.02\n" + std::string(kRecording), csv()},
      {"a key given twice", "[rig]\nsample_rate_hz = 1000\nsample_rate_hz = 500\n" + std::string(kRecording),
       csv()},
      {"a controller of two kinds",
       std::string(kRig) +
           "[[recording]]\nfile = \"step.csv\"\ncontroller = { type = \"pd\", kp_V_per_m = 1, h1_V = 2 }\n",
       csv()},
      {"a controller nobody knows",
       std::string(kRig) + "[[recording]]\nfile = \"step.csv\"\ncontroller = { type = \"lqr\" }\n", csv()},
      {"a repeat of nothing",
       std::string(kRig) + "[[recording]]\nfile = \"step.csv\"\nrepeat_of = \"other.csv\"\n", csv()},
      {"no recordings", kRig, csv()},
      {"TOML that is none", "[rig\n", csv()},
  };
}

struct SessionCommand {
  const char* name;
  Words (*arguments)(const std::string& session, const std::string& model, const std::string& out);
};

const SessionCommand kSessionCommands[] = {
    {"simulate",
     [](const std::string& s, const std::string& m, const std::string& o) {
       return Words{"simulate", "--model", m, "--session", s, "--out", o};
     }},
    {"evaluate",
     [](const std::string& s, const std::string& m, const std::string& o) {
       return Words{"evaluate", "--model", m, "--session", s, "--out", o, "--json"};
     }},
    {"identify",
     [](const std::string& s, const std::string&, const std::string& o) {
       return Words{"identify", "--session", s, "--terms", "viscous_friction", "--out", o, "--json"};
     }},
    {"export mat", [](const std::string& s, const std::string&,
                      const std::string& o) { return Words{"export", s, "--to", "mat", "--out", o}; }},
    {"export ulg", [](const std::string& s, const std::string&,
                      const std::string& o) { return Words{"export", s, "--to", "ulg", "--out", o}; }},
    {"plot", [](const std::string& s, const std::string& m,
                const std::string& o) { return Words{"plot", s, "--model", m, "--out", o}; }},
};

/// What every refusal has in common.
void expect_refused(const Words& arguments, const std::filesystem::path& out) {
  const Finished finished = cartwright(arguments);
  EXPECT_EQ(finished.status, 2) << finished.out;
  EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  EXPECT_TRUE(finished.err.starts_with("cartwright: ")) << finished.err;
  EXPECT_EQ(finished.out, "");
  EXPECT_FALSE(std::filesystem::exists(out)) << out;
}

TEST(BadInput, SessionsAreRefusedByEveryCommandThatReadsThem) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  for (const BadSession& bad : bad_sessions()) {
    const std::string session = scratch.text("session");
    std::filesystem::remove_all(session);
    std::filesystem::create_directories(session);
    if (!bad.toml.empty()) scratch.put("session/session.toml", bad.toml);
    if (!bad.recording.empty()) scratch.put("session/step.csv", bad.recording);
    for (const SessionCommand& command : kSessionCommands) {
      SCOPED_TRACE(std::string(command.name) + " with " + bad.what);
      expect_refused(command.arguments(session, scratch.text("model.toml"), scratch.text("out")),
                     scratch / "out");
    }
  }
}

TEST(BadInput, TheSessionThatTheOthersSpoilIsAccepted) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  scratch.put("session/session.toml", std::string(kRig) + kRecording);
  scratch.put("session/step.csv", csv());
  for (const SessionCommand& command : kSessionCommands) {
    const Finished finished = cartwright(command.arguments(
        scratch.text("session"), scratch.text("model.toml"), scratch.text("out_") + command.name));
    EXPECT_EQ(finished.status, 0) << command.name << ": " << finished.err;
    EXPECT_EQ(finished.err, "") << command.name;
  }
}

TEST(BadInput, ModelsAreRefused) {
  const std::pair<const char*, std::string> models[] = {
      {"none", ""},
      {"no gain", "[model.viscous_friction]\ncoefficient_per_s = 5\n"},
      {"an unknown term", std::string(kModel) + "[model.magic]\nstrength = 1\n"},
      {"an unknown parameter", "[model]\nvoltage_gain_m_per_s2_V = 1.9\n[model.backlash]\ngap_mm = 1\n"},
      {"a word for a number", "[model]\nvoltage_gain_m_per_s2_V = \"big\"\n"},
      {"a gain that is not finite", "[model]\nvoltage_gain_m_per_s2_V = nan\n"},
  };
  for (const auto& [what, text] : models) {
    const Scratch scratch;
    scratch.put("session/session.toml", std::string(kRig) + kRecording);
    scratch.put("session/step.csv", csv());
    if (!text.empty()) scratch.put("model.toml", text);
    for (const char* command : {"simulate", "evaluate"}) {
      SCOPED_TRACE(std::string(command) + " with " + what);
      expect_refused({command, "--model", scratch.text("model.toml"), "--session", scratch.text("session"),
                      "--out", scratch.text("out")},
                     scratch / "out");
    }
  }
}

TEST(BadInput, CommandLinesAreRefused) {
  const Scratch scratch;
  scratch.put("session/session.toml", std::string(kRig) + kRecording);
  scratch.put("session/step.csv", csv());
  scratch.put("relay_gains.toml", "[controller]\ntype = \"dual_relay\"\nh1_V = 2\nh2_V = 1\n");
  scratch.put("unknown_gains.toml", "[controller]\ntype = \"pd\"\nkp_V_per_m = 2\nki_V_per_m_s = 1\n");
  scratch.put("map.toml",
              "[rig]\nsample_rate_hz = 1000\n[channels]\nt_s = \"t_s\"\ny_m = \"nothing\"\nu_V = \"u_V\"\n");
  scratch.put("model.toml", kModel);
  scratch.put("reversed.toml", "[model]\nvoltage_gain_m_per_s2_V = -1.9\n");
  scratch.put("upside_down.toml",
              std::string(kModel) + "[intervals]\n\"voltage_gain_m_per_s2_V\" = [2.0, 1.8]\n");
  const std::string out = scratch.text("out"), session = scratch.text("session"),
                    file = scratch.text("session/step.csv"), model = scratch.text("model.toml");
  const Words commands[] = {
      {},
      {"fly"},
      {"simulate"},
      {"simulate", "--session", session, "--out", out},
      {"export", session, "--to", "xls", "--out", out},
      {"export", session, "--to", "mat", "--out", out, "--fast"},
      {"completion", "fish"},
      {"import", file, "--map", scratch.text("none.toml"), "--out", out},
      {"import", file, "--map", scratch.text("map.toml"), "--out", out},
      {"import", scratch.text("none.csv"), "--map", scratch.text("map.toml"), "--out", out},
      {"sinefit", file, "--column", "z_m", "--from", "0", "--to", "1"},
      {"sinefit", scratch.text("none.csv"), "--column", "y_m", "--from", "0", "--to", "1"},
      {"sinefit", file, "--column", "y_m", "--from", "1", "--to", "0"},
      {"design"},
      {"design", "--model", scratch.text("none.toml"), "--settling-time", "1", "--out", out},
      {"design", "--model", model, "--out", out},
      {"design", "--model", model, "--settling-time", "nan", "--out", out},
      {"design", "--model", model, "--settling-time", "-1", "--out", out},
      {"design", "--model", model, "--overshoot", "5", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--step", "0", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--kp", "100:20", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--kp", "soft", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--kd", "0:1e9", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--ki", "5", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--law", "lqr", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--ideal", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--session", scratch.text("none"), "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--session", session, "--step", "3", "--out", out},
      {"design", "--model", model, "--rise-time", "1", "--relay", scratch.text("none"), "--out", out},
      {"design", "--model", scratch.text("reversed.toml"), "--rise-time", "1", "--out", out},
      {"design", "--model", scratch.text("upside_down.toml"), "--rise-time", "1", "--out", out},
      {"device"},
      {"device", "status", "--port", "70000"},
      {"device", "run", "step", "--amplitude-m", "7"},
      {"device", "run", "step", "--pattern", "zigzag"},
      {"device", "run", "dance"},
      {"device", "pull"},
      {"device", "gains", "flash", scratch.text("none.toml")},
      {"device", "gains", "flash", scratch.text("relay_gains.toml")},
      {"device", "gains", "flash", scratch.text("unknown_gains.toml")},
      {"device", "gains", "activate", "3"},
      {"device", "watch", "--interval", "0"},
  };
  for (const Words& command : commands) {
    std::string line;
    for (const std::string& word : command) line += word + " ";
    SCOPED_TRACE(line);
    expect_refused(command, scratch / "out");
  }
}

TEST(BadInput, AWordThatIsNoCommandOrOptionIsNamed) {
  EXPECT_EQ(cartwright({"fly"}).err, "cartwright: there is no command fly; see cartwright --help\n");
  EXPECT_EQ(cartwright({"device", "fly"}).err,
            "cartwright: device has no command fly; see cartwright device --help\n");
  EXPECT_EQ(cartwright({"simulate", "--modle", "a.toml"}).err,
            "cartwright: simulate has no option --modle; see cartwright simulate --help\n");
}

TEST(BadInput, AColumnOfNotesIsNoObstacle) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  scratch.put("session/session.toml", std::string(kRig) + kRecording);
  scratch.put("session/step.csv", csv("t_s,r_m,y_m,u_V,note", [](int tick, const std::string& line) {
                return line + (tick == 700 ? ",\"braked, by hand\"" : ",");
              }));
  for (const SessionCommand& command : kSessionCommands) {
    const Finished finished = cartwright(command.arguments(
        scratch.text("session"), scratch.text("model.toml"), scratch.text("out_") + command.name));
    EXPECT_EQ(finished.status, 0) << command.name << ": " << finished.err;
  }
}

TEST(BadInput, RecordingsThatDifferByTheirExtensionAreBothEvaluated) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  scratch.put("session/session.toml",
              std::string(kRig) + kRecording + "\n[[recording]]\nfile = \"step.txt\"\n");
  scratch.put("session/step.csv", csv());
  scratch.put("session/step.txt", csv());
  const Finished finished = cartwright({"evaluate", "--model", scratch.text("model.toml"), "--session",
                                        scratch.text("session"), "--out", scratch.text("out")});
  EXPECT_EQ(finished.status, 0) << finished.err;
  EXPECT_TRUE(std::filesystem::exists(scratch / "out/step.csv.prediction.csv"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "out/step.txt.prediction.csv"));
}

TEST(BadInput, AFullDiskLeavesNothingBehind) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  scratch.put("session/session.toml", std::string(kRig) + kRecording);
  scratch.put("session/step.csv", csv());
  const test::SmallDisk full(800);  // more than any message, less than any output
  for (const SessionCommand& command : kSessionCommands) {
    if (std::string_view(command.name) == "identify") continue;  // but for a model, which still fits
    SCOPED_TRACE(command.name);
    const std::string out = std::string("out_") + command.name;
    expect_refused(command.arguments(scratch.text("session"), scratch.text("model.toml"), scratch.text(out)),
                   scratch / out);
  }
}

TEST(BadInput, StandardOutputThatCannotBeWrittenIsSaid) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  scratch.put("session/session.toml", std::string(kRig) + kRecording);
  scratch.put("session/step.csv", csv());
  const std::string programs[] = {
      std::string(CARTWRIGHT_PROGRAM) + " completion bash", std::string(CARTWRIGHT_PROGRAM) + " --help",
      std::string(CARTWRIGHTD_PROGRAM) + " --registers",
      std::string(CARTWRIGHT_PROGRAM) + " identify --json --terms viscous_friction --session " +
          scratch.text("session") + " --out " + scratch.text("found.toml")};
  for (const std::string& program : programs) {
    SCOPED_TRACE(program);
    const Finished finished = run("/bin/sh", {"-c", program + " >/dev/full"});
    EXPECT_EQ(finished.status, 2);
    EXPECT_THAT(finished.err, testing::HasSubstr("standard output cannot be written"));
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

TEST(BadInput, MissingRowsAreSaid) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  scratch.put("session/session.toml", std::string(kRig) + kRecording);
  std::string text = csv();
  const auto line = [&text](const char* start) { return text.find(std::string("\n") + start) + 1; };
  text.erase(line("0.700000"), line("0.800000") - line("0.700000"));
  scratch.put("session/step.csv", text);
  for (const SessionCommand& command : kSessionCommands) {
    const std::string_view name = command.name;
    if (name != "simulate" && name != "evaluate" && name != "identify") continue;
    const Finished finished = cartwright(command.arguments(
        scratch.text("session"), scratch.text("model.toml"), scratch.text("out_") + command.name));
    EXPECT_EQ(finished.status, 0) << finished.err;
    EXPECT_EQ(finished.err,
              "cartwright: note: step.csv: 100 rows are missing in 1 gap, the first after t_s = 0.699\n")
        << name;
  }
}

TEST(BadInput, ARecordingWithoutItsControlLawIsSaidToBeReplayed) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  scratch.put("session/session.toml",
              std::string(kRig) + "[[recording]]\nfile = \"step.csv\"\nexperiment = \"step\"\n");
  scratch.put("session/step.csv", csv());
  const Finished finished = cartwright({"simulate", "--model", scratch.text("model.toml"), "--session",
                                        scratch.text("session"), "--out", scratch.text("out")});
  EXPECT_EQ(finished.status, 0);
  EXPECT_EQ(finished.err,
            "cartwright: note: 1 of 1 recordings come without a control law: their voltage is replayed\n");
}

TEST(BadInput, AnOutputThatIsNoDirectoryIsRefused) {
  const Scratch scratch;
  scratch.put("model.toml", kModel);
  scratch.put("session/session.toml", std::string(kRig) + kRecording);
  scratch.put("session/step.csv", csv());
  for (const SessionCommand& command : kSessionCommands) {
    SCOPED_TRACE(command.name);
    expect_refused(command.arguments(scratch.text("session"), scratch.text("model.toml"), "/dev/full/out"),
                   "/dev/full/out");
  }
}

}  // namespace
}  // namespace cartwright::test
