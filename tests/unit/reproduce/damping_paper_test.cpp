// What the first paper's table must say, read from the table itself.
#include <gmock/gmock.h>

#include <sstream>

#include "host/identify/integral_form.hpp"
#include "host/reproduce/least_kd.hpp"
#include "host/reproduce/simulated_step.hpp"
#include "host/reproduce/table_1.hpp"
#include "host/reproduce/table_2.hpp"

namespace cartwright::reproduce {
namespace {

using testing::HasSubstr;

double number_after(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  EXPECT_NE(at, std::string::npos) << text;
  return std::stod(text.substr(at + word.size()));
}

const Item& item_named(const Section& section, const std::string& start) {
  for (const Item& item : section.items) {
    if (item.item.rfind(start, 0) == 0) return item;
  }
  ADD_FAILURE() << "no item " << start;
  return section.items.front();
}

TEST(DampingPaper, TheLeastKdIsWhatAGlobalSearchFinds) {
  const auto section = least_derivative_gain({});
  ASSERT_TRUE(section) << section.error().message;
  const std::string linear = item_named(*section, "Lm3: Kd that settle").obtained;
  const std::string nonlinear = item_named(*section, "NLm3: Kd that settle").obtained;
  EXPECT_NEAR(number_after(linear, "least "), 6.3, 0.1);
  EXPECT_NEAR(number_after(nonlinear, "least "), 3.8, 0.1);
  EXPECT_THAT(nonlinear, HasSubstr(" and ")) << "two stretches of Kd settle in time";
  EXPECT_NEAR(number_after(nonlinear, " to "), 4.75, 0.1);
}

TEST(DampingPaper, EveryResponseWithADerivativeMeetsTheVoltageLimit) {
  const auto section = voltage_ranges({});
  ASSERT_TRUE(section) << section.error().message;
  ASSERT_EQ(section->items.size(), kGainPairs.size());
  for (std::size_t i = 0; i < kGainPairs.size(); ++i) {
    std::istringstream values(section->items[i].obtained);
    double least, mean, greatest;
    char comma;
    values >> least >> comma >> mean >> comma >> greatest;
    const GainPair gains = kGainPairs[i];
    EXPECT_NEAR(greatest, gains.kd_V_s_per_m > 0 ? 12 : gains.kp_V_per_m * kStep_m, 0.01);
    EXPECT_LT(least, 0);
    EXPECT_GT(mean, 0);
  }
}

TEST(DampingPaper, NonlinearModelsPredictThreeTimesBetterWhicheverResponseTheyCameFrom) {
  const auto section = prediction_errors({});
  ASSERT_TRUE(section) << section.error().message;
  for (const char* average : {"average over 1 s", "average over 0.5 s"})
    EXPECT_GE(number_after(item_named(*section, average).obtained, "linear over non-linear "), 3) << average;
}

TEST(DampingPaper, AnUpperBoundOnTheRiseIsHeld) {
  const IdealResponse r = ideal_response(cart_at(60), {60, 0}, 0.9);
  std::vector<double> t_s, e_m;
  for (std::size_t i = 0; i < r.y_m.size(); ++i) {
    t_s.push_back(1e-3 * static_cast<double>(i));
    e_m.push_back(kStep_m - r.y_m[i]);
  }
  DampingConstraints falling;
  falling.greatest_rise_per_s = -0.5;
  const PiecewiseFit fit = PiecewiseForm({t_s, e_m, {}}, 6).fit(falling);
  EXPECT_LT(fit.solution.kkt.greatest(), 1e-8);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_LE(fit.damping_per_s[i], fit.damping_per_s[i - 1] - 0.5 + 1e-6);
}

}  // namespace
}  // namespace cartwright::reproduce
