#include <gtest/gtest.h>

#include <cmath>

#include "host/diagnose/diagnosis.hpp"
#include "tests/diagnose/independent_cart.hpp"

namespace cartwright {
namespace {

using P = Parameter;

/// Friction that carries more and more of its level the farther the cart moves one way, from place to place,
/// and resists the speed at which it gives.
class DahlBristle {
 public:
  DahlBristle(double level_m_per_s2, double stiffness_per_s2, double damping_per_s = 0,
              double damping_speed_m_per_s = INFINITY)
      : level_(level_m_per_s2),
        per_m_(stiffness_per_s2 / level_m_per_s2),
        damping_(damping_per_s),
        damping_speed_(damping_speed_m_per_s) {}

  double push(double t_s, double y_m, double v_m_per_s) {
    if (t_s < last_t_s_) share_ = 0, last_y_m_ = y_m;  // another recording
    const double moved_m = y_m - last_y_m_, side = moved_m > 0 ? 1 : -1;
    share_ = side * (1 - (1 - side * share_) * std::exp(-per_m_ * std::abs(moved_m)));
    last_t_s_ = t_s, last_y_m_ = y_m;
    const double gives = v_m_per_s * (1 - (v_m_per_s > 0 ? share_ : -share_));
    const double slow = v_m_per_s / damping_speed_;
    return -level_ * share_ - damping_ * std::exp(-slow * slow) * gives;
  }

 private:
  double level_, per_m_, damping_, damping_speed_;
  double share_ = 0, last_y_m_ = 0, last_t_s_ = 1e9;
};

/// What the diagnosis makes of a cart that hides it, which must be its name and nothing else.
Diagnosis named(DahlBristle bristle, double level_m_per_s2) {
  test::IndependentCart cart;
  cart.coulomb_m_per_s2 = 0;
  cart.push = [&bristle](double t, double y, double v) { return bristle.push(t, y, v); };
  Diagnosis d = diagnose(test::battery(cart), test::nominal(1.9, 5, level_m_per_s2));
  EXPECT_EQ(d.effects.size(), 1u) << name(d.verdict);
  EXPECT_TRUE(!d.effects.empty() && d.effects.front().term == Term::presliding_friction);
  EXPECT_FALSE(d.unexplained.has_value());
  return d;
}

double damping_per_s(double stiffness_per_s2, double ratio) {
  return 2 * ratio * std::sqrt(stiffness_per_s2);
}

/// An elastic bristle leaves a quarter of this and more, which is then refused or gets a second name.
TEST(Dahl, ABristleThatGivesMoreAndMoreIsNamedWithItsStiffness) {
  const Diagnosis d = named({0.4, 1.2e4}, 0.4);
  EXPECT_EQ(d.model[P::presliding_dahl_exponent], 1);
  EXPECT_NEAR(d.model[P::presliding_stiffness], 1.2e4, 600);
}

/// Without its damping this one is unexplained.
TEST(Dahl, ADampedBristleIsNamedWithItsDamping) {
  constexpr double kStiffness = 1.2e4, kRatio = 0.3;
  const Diagnosis d = named({0.4, kStiffness, damping_per_s(kStiffness, kRatio)}, 0.4);
  EXPECT_NEAR(d.model[P::presliding_stiffness], kStiffness, 0.05 * kStiffness);
  EXPECT_NEAR(d.model[P::presliding_damping_ratio], kRatio, 0.05 * kRatio);
}

/// Fading, the damping cannot make friction add energy.
TEST(Dahl, ABristleWhoseDampingFadesIsNamedWithItsNumbers) {
  constexpr double kStiffness = 1.2e4, kRatio = 0.5, kSpeed_m_per_s = 0.01;
  const Diagnosis d = named({0.6, kStiffness, damping_per_s(kStiffness, kRatio), kSpeed_m_per_s}, 0.6);
  EXPECT_NEAR(d.model[P::presliding_stiffness], kStiffness, 0.1 * kStiffness);
  EXPECT_NEAR(d.model[P::presliding_damping_ratio], kRatio, 0.15 * kRatio);
  EXPECT_NEAR(d.model[P::presliding_damping_speed], kSpeed_m_per_s, 0.15 * kSpeed_m_per_s);
}

}  // namespace
}  // namespace cartwright
