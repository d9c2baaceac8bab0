// [intervals] of a model file: round trip, entries without bounds, refusals that say where.
#include "common/config/interval_toml.hpp"

#include <gmock/gmock.h>

#include <limits>

#include "common/config/model_toml.hpp"

namespace cartwright {
namespace {

using testing::HasSubstr;

Model viscous_cart() {
  Model model(1.9);
  model.set(Parameter::viscous_coefficient, 5);
  return model;
}

TEST(IntervalToml, ComesBackAsWrittenBesideItsModel) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ParameterInterval> intervals = {{Parameter::voltage_gain, 1.85, 1.95},
                                                    {Parameter::viscous_coefficient, nan, nan}};
  const std::string text = to_toml(viscous_cart()) + intervals_to_toml(intervals);
  ASSERT_TRUE(model_from_toml(text, "m.toml"));
  const auto again = intervals_from_toml(text, "m.toml", viscous_cart());
  ASSERT_TRUE(again) << again.error().message;
  ASSERT_EQ(again->size(), 1u);
  EXPECT_EQ((*again)[0].id, Parameter::voltage_gain);
  EXPECT_EQ((*again)[0].low, 1.85);
  EXPECT_EQ((*again)[0].high, 1.95);
}

TEST(IntervalToml, NoTableIsNoIntervalsAndNanIsNoBound) {
  EXPECT_TRUE(intervals_from_toml(to_toml(viscous_cart()), "m.toml", viscous_cart())->empty());
  EXPECT_TRUE(intervals_to_toml({}).empty());
  const auto none =
      intervals_from_toml("[intervals]\n\"voltage_gain_m_per_s2_V\" = [nan, nan]\n", "m", viscous_cart());
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
}

TEST(IntervalToml, RefusesWhatIsNoIntervalAndSaysWhere) {
  const auto message = [](const std::string& line) {
    const auto read = intervals_from_toml("[intervals]\n" + line + "\n", "m.toml", viscous_cart());
    return read ? std::string("accepted") : read.error().message;
  };
  EXPECT_THAT(message("\"beta\" = [1, 2]"), HasSubstr("m.toml:2: \"beta\""));
  EXPECT_THAT(message("\"backlash.gap_m\" = [1, 2]"), HasSubstr("no [model.backlash]"));
  EXPECT_THAT(message("\"voltage_gain_m_per_s2_V\" = [2, 1]"), HasSubstr("above"));
  EXPECT_THAT(message("\"voltage_gain_m_per_s2_V\" = [2]"), HasSubstr("[low, high]"));
  EXPECT_THAT(message("\"voltage_gain_m_per_s2_V\" = 2"), HasSubstr("[low, high]"));
  EXPECT_THAT(message("\"voltage_gain_m_per_s2_V\" = [\"a\", 1]"), HasSubstr("[low, high]"));
}

}  // namespace
}  // namespace cartwright
