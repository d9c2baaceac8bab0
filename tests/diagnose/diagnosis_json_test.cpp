#include "host/diagnose/diagnosis_json.hpp"

#include <gmock/gmock.h>

#include "common/config/model_toml.hpp"

namespace cartwright {
namespace {

TEST(ModelWithIntervals, IsAModelFileWhateverItsFlags) {
  Diagnosis d;
  d.model = Model(1.9).set(Parameter::viscous_coefficient, 5).set(Parameter::transport_delay, 0.002);
  d.parameters.push_back({Parameter::voltage_gain, 1.8, {1.9, 1.89, 1.91}, 1.9});
  Effect effect{Term::transport_delay, 0.9, {}, {}, {}, {}, 0, 50, {}, ""};
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

}  // namespace
}  // namespace cartwright
