#include "host/diagnose/locate/acts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// The places of an effect of a model beside recordings of a cart that has it.
Where acts(Term effect, const Model& model, const test::IndependentCart& cart) {
  const Session session = test::battery(cart);
  const FitOptions options = options_for(session, model);
  const Fit fitted = fit(session, model, search_noise(session, model, options), {}, options);
  return Acts(session, fitted, options).where(effect);
}

Model with(std::initializer_list<std::pair<P, double>> numbers) {
  Model model = test::nominal(1.9, 5, 0.4);
  for (const auto& [id, value] : numbers) model.set(id, value);
  return model;
}

TEST(Acts, ASpotWhereItLies) {
  test::IndependentCart cart;
  cart.extra_level = [](double, double y, double, double) {
    return 1.5 * std::exp(-0.5 * std::pow((y - 0.03) / 0.01, 2));
  };
  const Where where = acts(Term::position_dependent_friction,
                           with({{P::spot_peak, 1.5}, {P::spot_centre, 0.03}, {P::spot_width, 0.01}}), cart);
  ASSERT_EQ(where.at("position_m").size(), 2U);
  EXPECT_NEAR(where.at("position_m")[0], 0.02, 0.01);
  EXPECT_NEAR(where.at("position_m")[1], 0.04, 0.01);
}

TEST(Acts, ASaturationBeyondItsLimitOnly) {
  test::IndependentCart cart;
  cart.amplifier = [](double u) { return std::clamp(u, -3.0, 3.0); };
  const Where where = acts(Term::voltage_saturation, with({{P::saturation_limit, 3}}), cart);
  const std::vector<double>& voltage = where.at("voltage_V");
  ASSERT_EQ(voltage.size(), 2U);
  EXPECT_GE(std::min(std::abs(voltage[0]), std::abs(voltage[1])), 3);
  EXPECT_GT(voltage[0] * voltage[1], 0) << "one side";
}

TEST(Acts, AnExcessOfFrictionAtLowSpeed) {
  test::IndependentCart cart;
  cart.extra_level = [](double, double, double v, double) { return 0.5 * std::exp(-std::pow(v / 0.05, 2)); };
  const Where where =
      acts(Term::stribeck_friction, with({{P::stribeck_excess, 0.5}, {P::stribeck_speed, 0.05}}), cart);
  const std::vector<double>& speed = where.at("velocity_m_per_s");
  ASSERT_EQ(speed.size(), 2U);
  EXPECT_LT(std::abs(speed[0]), 0.06);
  EXPECT_LT(std::abs(speed[1]), 0.06);
}

TEST(Acts, AConstantForceEverywhereAtNoFrequency) {
  test::IndependentCart cart;
  cart.push = [](double, double, double) { return 0.3; };
  const Where where = acts(Term::constant_force, with({{P::constant_acceleration, 0.3}}), cart);
  for (const auto& [axis, stretch] : where) EXPECT_TRUE(stretch.empty() || axis == "frequency_hz") << axis;
  ASSERT_EQ(where.at("frequency_hz").size(), 2U);
  EXPECT_LT(where.at("frequency_hz").back(), 2);  // a push that the cart does not answer where it sticks
}

TEST(Acts, AnErrorOfTheEncoderPushesNothing) {
  const Where where = acts(Term::encoder_eccentricity,
                           with({{P::eccentricity_amplitude, 1e-4}, {P::eccentricity_period, 0.02}}), {});
  for (const auto& [axis, stretch] : where) EXPECT_TRUE(stretch.empty()) << axis;
}

}  // namespace
}  // namespace cartwright
