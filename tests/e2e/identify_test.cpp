#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/e2e/process.hpp"

namespace cartwright::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using Words = std::vector<std::string>;

/// Eq. (73) of Wongvanich, Hann and Sirisena (2015).
constexpr double kGain = 1.9165, kAlpha1 = 17.3264, kAlpha2 = 13.1068, kGamma = 5.9986;

std::string non_linear_cart() {
  return "[model]\nvoltage_gain_m_per_s2_V = " + std::to_string(kGain) +
         "\n[model.exponential_damping]\nalpha1_per_s = " + std::to_string(kAlpha1) +
         "\nalpha2_s_per_m = " + std::to_string(kAlpha2) + "\ngamma_per_s = " + std::to_string(kGamma) + "\n";
}

constexpr const char* kSession =
    "[rig]\nname = \"cart\"\nsample_rate_hz = 1000\nencoder_resolution_m = 2.275e-5\nvoltage_limit_V = 12.0\n"
    "travel_m = [-0.4, 0.4]\n"
    "[[recording]]\nfile = \"step.csv\"\nexperiment = \"step\"\n"
    "controller = { type = \"pd\", kp_V_per_m = 60, kd_V_s_per_m = 0 }\n"
    "[[recording]]\nfile = \"clipped.csv\"\nexperiment = \"step\"\n"
    "controller = { type = \"pd\", kp_V_per_m = 200, kd_V_s_per_m = 0 }\n"
    "[[recording]]\nfile = \"foreign.csv\"\nexperiment = \"step\"\n";

std::string step_of_reference() {
  std::string text = "t_s,r_m,y_m,u_V\n";
  for (int tick = 0; tick < 1200; ++tick)
    text += std::to_string(tick * 1e-3) + (tick < 100 ? ",0,0,0\n" : ",0.1,0,0\n");
  return text;
}

/// Steps of the published cart, one of them clipped, and one recording without a controller.
class IdentifyCommand : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = new Scratch;
    scratch_->put("cart.toml", non_linear_cart());
    scratch_->put("reference/session.toml", std::string(kSession));
    for (const char* file : {"step.csv", "clipped.csv", "foreign.csv"})
      scratch_->put(std::string("reference/") + file, step_of_reference());
    simulated_ = cartwright({"simulate", "--model", scratch_->text("cart.toml"), "--session",
                             scratch_->text("reference"), "--out", session()});
  }
  static void TearDownTestSuite() {
    delete scratch_;
    scratch_ = nullptr;
  }
  void SetUp() override { ASSERT_EQ(simulated_.status, 0) << simulated_.err; }

  static std::string session() { return scratch_->text("session"); }
  static std::string out() { return scratch_->text("model.toml"); }

  /// `cartwright identify` on that session.
  static Finished identify(Words arguments) {
    std::filesystem::remove(out());
    Words all{"identify", "--session", session(), "--out", out()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return cartwright(all);
  }
  static json identify_json(Words arguments) {
    arguments.push_back("--json");
    const Finished finished = identify(arguments);
    EXPECT_EQ(finished.status, 0) << finished.err;
    return json::parse(finished.out, nullptr, false);
  }
  static double value(const json& document, const char* name) {
    return document["parameters"][name]["value"].get<double>();
  }
  static void expect_refused(const Words& arguments, const std::string& says) {
    const Finished finished = identify(arguments);
    EXPECT_EQ(finished.status, 2) << finished.out;
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
    EXPECT_THAT(finished.err, HasSubstr(says));
    EXPECT_EQ(finished.out, "");
    EXPECT_FALSE(std::filesystem::exists(out()));
  }

 private:
  inline static Scratch* scratch_ = nullptr;
  inline static Finished simulated_;
};

TEST_F(IdentifyCommand, PiecewiseGivesGainIntervalsAndLaw) {
  const json found = identify_json({"--form", "piecewise"});
  EXPECT_NEAR(value(found, "voltage_gain_m_per_s2_V"), kGain, 0.02 * kGain);
  EXPECT_EQ(found["not_separable"], json::array());
  ASSERT_EQ(found["damping"].size(), 6u);
  double end_s = found["damping"][0]["start_s"].get<double>();
  EXPECT_NEAR(end_s, 0.1, 2e-3) << "from the step on";
  for (const json& one : found["damping"]) {
    EXPECT_EQ(one["start_s"].get<double>(), end_s) << "without a gap";
    end_s = one["end_s"].get<double>();
    const json& damping = one["damping_per_s"];
    EXPECT_GT(damping["value"].get<double>(), 0.5 * kGamma);
    EXPECT_LT(damping["value"].get<double>(), 1.2 * (kAlpha1 + kGamma));
    EXPECT_LT(damping["low"].get<double>(), damping["high"].get<double>());
  }
  EXPECT_LT(found["kkt_residual"]["greatest"].get<double>(), 1e-8);
  for (const char* name : {"exponential_damping.alpha1_per_s", "exponential_damping.alpha2_s_per_m",
                           "exponential_damping.gamma_per_s"}) {
    EXPECT_GE(value(found, name), 0) << name;
  }
  // The law predicts the step it came from; a model file came out that the other commands read.
  const Finished evaluated = cartwright(
      {"evaluate", "--model", out(), "--session", session(), "--out", session() + "_predicted", "--json"});
  ASSERT_EQ(evaluated.status, 0) << evaluated.err;
  EXPECT_LT(json::parse(evaluated.out)["recordings"][0]["closed_loop_rmse_m"].get<double>(), 1e-3);
}

TEST_F(IdentifyCommand, SimulationRefitsAModelFile) {
  ASSERT_EQ(identify({"--form", "piecewise"}).status, 0);
  const std::string start = session() + "_start.toml";
  std::filesystem::copy_file(out(), start, std::filesystem::copy_options::overwrite_existing);
  const json found = identify_json(
      {"--form", "simulation", "--model", start, "--hold", "exponential_damping.alpha2_s_per_m"});
  EXPECT_NEAR(value(found, "voltage_gain_m_per_s2_V"), kGain, 0.02 * kGain);
  EXPECT_EQ(found["held"], json::array({"exponential_damping.alpha2_s_per_m"}));
  const json& error = found["open_loop_rmse_m"];
  EXPECT_LT(error["after"].get<double>(), error["before"].get<double>());
  EXPECT_TRUE(error["held_out"].is_number());
  // The error it tells is the one that evaluate calls open loop.
  const Finished evaluated = cartwright(
      {"evaluate", "--model", out(), "--session", session(), "--out", session() + "_refitted", "--json"});
  ASSERT_EQ(evaluated.status, 0) << evaluated.err;
  EXPECT_NEAR(json::parse(evaluated.out)["open_loop_rmse_m"].get<double>(), error["after"].get<double>(),
              1e-9);
}

TEST_F(IdentifyCommand, SimulationRefusesWhatItCannotUse) {
  const std::string nominal = session() + "_nominal.toml";
  ASSERT_EQ(identify({}).status, 0);
  std::filesystem::copy_file(out(), nominal, std::filesystem::copy_options::overwrite_existing);
  expect_refused({"--form", "simulation"}, "--model FILE");
  expect_refused({"--form", "simulation", "--model", nominal, "--terms", "cogging"}, "--terms belongs to");
  expect_refused({"--form", "simulation", "--model", nominal, "--hold", "cogging.period_m"},
                 "holds no such number");
  expect_refused({"--form", "simulation", "--model", "no.toml"}, "no.toml");
  expect_refused({"--model", nominal}, "--model belongs to --form simulation");
}

TEST_F(IdentifyCommand, TheRecordedVoltageServesAClippedStepToo) {
  const json found =
      identify_json({"--form", "piecewise", "--recording", "clipped.csv", "--input", "voltage"});
  EXPECT_EQ(found["recording"], "clipped.csv");
  EXPECT_NEAR(value(found, "voltage_gain_m_per_s2_V"), kGain, 0.03 * kGain);
}

TEST_F(IdentifyCommand, ConstraintsOfTheCommandLineHold) {
  const auto damping = [](const json& found) {
    std::vector<double> out;
    for (const json& one : found["damping"]) out.push_back(one["damping_per_s"]["value"].get<double>());
    return out;
  };
  const auto rising =
      damping(identify_json({"--form", "piecewise", "--monotone", "0.5", "--duration", "0.45"}));
  const auto slow = damping(
      identify_json({"--form", "piecewise", "--intervals", "9", "--slope", "12", "--duration", "0.9"}));
  ASSERT_EQ(rising.size(), 6u);
  ASSERT_EQ(slow.size(), 9u);
  for (std::size_t i = 1; i < rising.size(); ++i) EXPECT_GE(rising[i] - rising[i - 1], 0.5 - 1e-6);
  double steepest = 0;
  for (std::size_t i = 1; i < slow.size(); ++i)
    steepest = std::max(steepest, std::abs(slow[i] - slow[i - 1]));
  // 0.9 s in 9 intervals are 0.1 s each; the law of this cart is steeper, so that the bound is reached.
  EXPECT_NEAR(steepest, 1.2, 0.01);
}

TEST_F(IdentifyCommand, ErrorGivesGainAndConstantDamping) {
  const json found = identify_json({"--form", "error"});
  EXPECT_NEAR(value(found, "voltage_gain_m_per_s2_V"), 1.81, 0.03 * 1.81) << "as the paper finds";
  EXPECT_NEAR(value(found, "viscous_friction.coefficient_per_s"), 6.14, 0.03 * 6.14) << "as the paper finds";
  EXPECT_EQ(found["damping"].size(), 1u);
}

TEST_F(IdentifyCommand, TheTableHoldsTheSameNumbers) {
  const Finished finished = identify({"--form", "piecewise"});
  ASSERT_EQ(finished.status, 0) << finished.err;
  for (const char* part : {"voltage_gain_m_per_s2_V", "exponential_damping.alpha2_s_per_m", "damping [1/s]",
                           "KKT residual", "mm rms"}) {
    EXPECT_THAT(finished.out, HasSubstr(part));
  }
}

TEST_F(IdentifyCommand, TheDriveGivesForcesInBothOutputs) {
  const Words terms{"--terms", "viscous_friction", "--drive", "38"};
  const json found = identify_json(terms);
  const double mass_kg = found["forces"]["moving_mass_kg"]["value"].get<double>();
  EXPECT_NEAR(mass_kg * value(found, "voltage_gain_m_per_s2_V"), 38, 1e-9);
  EXPECT_NEAR(found["forces"]["viscous_friction.coefficient_N_s_per_m"]["value"].get<double>(),
              mass_kg * value(found, "viscous_friction.coefficient_per_s"), 1e-6);
  EXPECT_THAT(identify(terms).out, HasSubstr("moving_mass_kg"));
  EXPECT_FALSE(identify_json({"--terms", "viscous_friction"}).contains("forces"));
}

TEST_F(IdentifyCommand, RefusesInOneLine) {
  expect_refused({"--form", "magic"}, "magic");
  expect_refused({"--terms", "viscous_friction,magic"}, "known are");
  expect_refused({"--form", "error", "--recording", "none.csv"}, "none.csv");
  expect_refused({"--form", "error", "--recording", "foreign.csv"}, "PD controller");
  expect_refused({"--form", "piecewise", "--intervals", "0"}, "--intervals");
  expect_refused({"--form", "piecewise", "--intervals", "2"}, "three");
  expect_refused({"--form", "piecewise", "--intervals", "300"}, "rows");
  expect_refused({"--form", "piecewise", "--slope", "-1"}, "--slope");
  expect_refused({"--form", "piecewise", "--monotone", "nan"}, "--monotone");
  expect_refused({"--form", "piecewise", "--terms", "viscous_friction"},
                 "--terms belongs to --form recorded");
  expect_refused({"--form", "error", "--input", "voltage"}, "--input belongs to --form piecewise");
  expect_refused({"--form", "error", "--drive", "35"}, "--drive belongs to --form recorded");
  expect_refused({"--drive", "35", "--mass", "20"}, "--drive excludes --mass");
  expect_refused({"--drive", "-1"}, "--drive");
  expect_refused({"--intervals", "6"}, "--intervals belongs to --form piecewise");
}

TEST_F(IdentifyCommand, OptionsThatAMessageNamesExist) {
  const std::string help = cartwright({"identify", "--help"}).out;
  const std::vector<Words> refusals{{"--form", "error", "--recording", "clipped.csv"},
                                    {"--form", "error", "--terms", "viscous_friction"},
                                    {"--slope", "5"},
                                    {"--terms", "magic"}};
  std::size_t named = 0;
  for (const Words& arguments : refusals) {
    const std::string message = identify(arguments).err;
    for (std::size_t at = message.find("--"); at != std::string::npos; at = message.find("--", at + 2)) {
      const std::size_t end = message.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", at);
      EXPECT_THAT(help, HasSubstr("  " + message.substr(at, end - at) + " ")) << message;
      ++named;
    }
  }
  EXPECT_GE(named, 7u);
}

}  // namespace
}  // namespace cartwright::test
