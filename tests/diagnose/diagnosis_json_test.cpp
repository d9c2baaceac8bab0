#include "host/diagnose/show/diagnosis_json.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "common/config/model_toml.hpp"

namespace cartwright {
namespace {

TEST(ModelWithIntervals, IsAModelFileWhateverItsFlags) {
  Diagnosis d;
  d.model = Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::transport_delay, 0.002);
  d.parameters.push_back({Parameter::voltage_gain, 1.8, {1.9, 1.89, 1.91}, 1.9});
  Effect effect{Term::transport_delay, 0.9, {}, {}, {}, {}, 0, 50, {}, "", {}};
  effect.parameters.emplace_back(Parameter::transport_delay, Estimate{0.002, 0.001, 0.003});
  effect.at_bound = {Parameter::transport_delay};
  effect.equivalent = {Term::armature_lag, Term::presliding_friction};
  d.effects.push_back(effect);
  const std::string text = model_with_intervals(d);
  EXPECT_THAT(text, testing::HasSubstr("not separable from armature_lag, presliding_friction"));
  const auto model = model_from_toml(text, "model.toml");
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ((*model)[Parameter::transport_delay], 0.002);
}

TEST(EffectOfADiagnosis, SaysWhatEachRecordingSays) {
  Diagnosis d;
  Effect effect{Term::cogging, 0.9, {}, {}, {}, {}, 0, 50, {}, "", {}};
  d.effects = {effect};
  EXPECT_TRUE(nlohmann::json::parse(to_json(d))["effects"][0]["window_rmse_without_m"].is_null());
  d.effects.front().support.recordings = {{"step.csv", 40, 8}};
  d.effects.front().support.windows_without_m = 5e-4;
  const auto json = nlohmann::json::parse(to_json(d))["effects"][0];
  EXPECT_EQ(json["window_rmse_without_m"], 5e-4);
  EXPECT_EQ(json["recordings"][0]["file"], "step.csv");
  EXPECT_EQ(json["recordings"][0]["gain_nats"], 40);
  EXPECT_EQ(json["recordings"][0]["standard_error_nats"], 8);
}

TEST(ClosedLoopErrors, AreThereWhereThereIsAController) {
  Diagnosis d;
  d.used = {9e-4, 6e-4, 8e-5};
  d.used_closed_loop = {1e-3, 7e-4, 9e-5};
  auto json = nlohmann::json::parse(to_json(d));
  EXPECT_EQ(json["fit"]["window_rmse_m"]["with_effects"], 8e-5);
  EXPECT_EQ(json["closed_loop_rmse_m"]["used"]["with_effects"], 9e-5);
  EXPECT_TRUE(json["fit"]["held_out"].is_null());

  const double none = std::numeric_limits<double>::quiet_NaN();
  d.used_closed_loop = {none, none, none};
  json = nlohmann::json::parse(to_json(d));
  EXPECT_TRUE(json["closed_loop_rmse_m"]["used"]["nominal"].is_null());
}

TEST(MissingForce, IsATableOfTheAxisThatCarriesIt) {
  Unexplained left;
  left.axis = "velocity_m_per_s";
  left.curve.low = {-0.5, 0};
  left.curve.high = {0, 0.5};
  left.curve.push_m_per_s2 = {0.125, -0.25};
  left.curve.band_m_per_s2 = {0.01, 0.02};
  EXPECT_EQ(missing_force_csv(left),
            "velocity_m_per_s_low,velocity_m_per_s_high,push_m_per_s2,band_m_per_s2\n"
            "-0.5,0,0.125,0.01\n0,0.5,-0.25,0.02\n");
}

}  // namespace
}  // namespace cartwright
