#include "common/config/model_toml.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cartwright {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view text) {
  const auto model = model_from_toml(text, "m.toml");
  return model ? "accepted" : model.error().message;
}

TEST(ModelToml, EveryTermAndParameterSurvivesWritingAndReading) {
  Model model(1.9);
  double next = 0.5;
  for (const ParameterInfo& parameter : parameters()) {
    if (!parameter.term) continue;
    next += 0.0137;
    model.set(parameter.id,
              std::min(next, parameter.upper) == next ? next : 0.5 * parameter.upper + next * 1e-3);
  }
  model.disturbance_recording = "odd \"name\" \\ with\ttab.csv";
  const auto again = model_from_toml(to_toml(model), "m.toml");
  ASSERT_TRUE(again.has_value()) << again.error().message;
  for (const TermInfo& term : terms()) EXPECT_TRUE(again->has(term.id)) << term.name;
  for (const ParameterInfo& parameter : parameters()) {
    EXPECT_EQ((*again)[parameter.id], model[parameter.id]) << parameter.key;
  }
  EXPECT_EQ(again->disturbance_recording, model.disturbance_recording);
}

TEST(ModelToml, EachTermAloneReadsBackAloneWithoutTheOthers) {
  for (const TermInfo& term : terms()) {
    Model model(-2.0);
    model.add(term.id);
    for (const ParameterInfo& parameter : parameters_of(term.id)) {
      if (!parameter.default_value) model.set(parameter.id, std::min(parameter.upper, 1.0) / 8);
    }
    const auto again = model_from_toml(to_toml(model), "m.toml");
    ASSERT_TRUE(again.has_value()) << again.error().message;
    for (const TermInfo& other : terms()) EXPECT_EQ(again->has(other.id), other.id == term.id) << term.name;
  }
}

TEST(ModelToml, OtherTablesAreLeftAlone) {
  EXPECT_TRUE(
      model_from_toml("[made]\nby = 'hand'\n[model]\nvoltage_gain_m_per_s2_V = 1\n", "m.toml").has_value());
}

TEST(ModelToml, RefusesWithTheLineAndWhatWouldBeRight) {
  const std::string head = "[model]\nvoltage_gain_m_per_s2_V = 1.9\n";
  EXPECT_THAT(refusal(""), HasSubstr("m.toml: no [model] table"));
  EXPECT_THAT(refusal("[model]\n"), HasSubstr("voltage_gain_m_per_s2_V"));
  EXPECT_THAT(refusal("[model]\nvoltage_gain_m_per_s2_V = 'x'\n"), HasSubstr("m.toml:2"));
  EXPECT_THAT(refusal("[model]\nvoltage_gain_m_per_s2_V = nan\n"), HasSubstr("finite"));
  EXPECT_THAT(refusal(head + "beta = 3\n"), HasSubstr("m.toml:3"));
  EXPECT_THAT(refusal(head + "[model.viscous]\nc = 1\n"), HasSubstr("unknown term [model.viscous]"));
  EXPECT_THAT(refusal(head + "[model.presliding_friction]\nstiffness_per_s2 = 1e4\ndamping_ratio = 0.1\n"),
              HasSubstr("needs dahl_exponent > 0"));
  EXPECT_THAT(refusal(head + "[model.viscous_friction]\n"), HasSubstr("lacks coefficient_per_s"));
  EXPECT_THAT(refusal(head + "[model.viscous_friction]\ncoefficient_per_s = -1\n"), HasSubstr("m.toml:4"));
  EXPECT_THAT(refusal(head + "[model.viscous_friction]\ncoefficient_per_s = 1\nspeed = 2\n"),
              HasSubstr("unknown key speed"));
  EXPECT_THAT(refusal(head + "[model.transport_delay]\ndelay_s = 3\n"), HasSubstr("outside [0, 0.1]"));
  EXPECT_THAT(refusal("[model\n"), HasSubstr("m.toml:1"));
  EXPECT_THAT(refusal(head + "[model.viscous_friction]\ncoefficient_per_s=1\n[model.viscous_friction]\n"),
              HasSubstr("m.toml:"));
}

TEST(Vocabulary, NamesAreFoundAndTheirTablesAgree) {
  std::size_t count = 1;  // the gain
  for (const TermInfo& term : terms()) {
    EXPECT_EQ(find_term(term.name), term.id);
    count += parameters_of(term.id).size();
    for (const ParameterInfo& parameter : parameters_of(term.id)) {
      EXPECT_EQ(find_parameter(dotted_name(parameter.id)), parameter.id);
      EXPECT_LT(parameter.lower, parameter.upper);
      if (parameter.default_value) {
        EXPECT_GE(*parameter.default_value, parameter.lower);
      }
    }
  }
  EXPECT_EQ(count, kParameterCount);
  EXPECT_EQ(find_parameter("voltage_gain_m_per_s2_V"), Parameter::voltage_gain);
  EXPECT_FALSE(find_term("friction").has_value());
  EXPECT_FALSE(find_parameter("viscous_friction.level").has_value());
}

}  // namespace
}  // namespace cartwright
