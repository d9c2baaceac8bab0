#include "host/diagnose/observe/two_mass_gain.hpp"

#include <gtest/gtest.h>

namespace cartwright {
namespace {

using P = Parameter;

constexpr double kPeriod_s = 1e-3, kViscous_per_s = 5, kLine_m = 2e-5;
constexpr int kSettled = 5000;

Model with_gap(double load_share) {
  Model model(2);
  model.set(P::backlash_gap, 4e-4)
      .set(P::backlash_load_share, load_share)
      .set(P::backlash_load_friction_share, 0.5)
      .set(P::backlash_load_damping_share, 0.5)
      .set(P::backlash_contact_resonance, 250)
      .set(P::backlash_contact_damping_ratio, 0.2);
  return model;
}

TwoMassGain::Gain settled(TwoMassGain& gain, bool in_contact) {
  for (int k = 0; k < kSettled; ++k) gain.step(in_contact);
  return gain.step(in_contact);
}

TEST(TwoMassGain, InContactWithAMotorThatWeighsNothingItIsTheGainOfOneMass) {
  const NoiseModel noise{1e4, 0.003};
  TwoMassGain gain(with_gap(0.99), noise, kPeriod_s, kViscous_per_s, kLine_m);
  const TwoMassGain::Gain two = settled(gain, true);
  const ObserverGain one = observer_gains(noise, kPeriod_s, kViscous_per_s).settled;
  EXPECT_NEAR(two.position, one.position, 0.02 * one.position);
  EXPECT_NEAR(two.velocity_per_s, one.velocity_per_s, 0.02 * one.velocity_per_s);
  EXPECT_NEAR(two.error_variance_ratio, one.error_variance_ratio, 0.01 * one.error_variance_ratio);
}

TEST(TwoMassGain, InContactTheMotorIsCorrectedAsTheCartIs) {
  TwoMassGain gain(with_gap(0.4), {1e4, 0.003}, kPeriod_s, kViscous_per_s, kLine_m);
  const TwoMassGain::Gain in_contact = settled(gain, true);
  EXPECT_NEAR(in_contact.motor_position, in_contact.position, 0.02 * in_contact.position);
  EXPECT_NEAR(in_contact.motor_velocity_per_s, in_contact.velocity_per_s, 0.02 * in_contact.velocity_per_s);
}

TEST(TwoMassGain, InTheGapAReadingComesToTellNothingOfTheMotor) {
  TwoMassGain gain(with_gap(0.4), {1e4, 0.003}, kPeriod_s, kViscous_per_s, kLine_m);
  settled(gain, true);
  const TwoMassGain::Gain apart = settled(gain, false);
  EXPECT_LT(std::abs(apart.motor_position), 0.05 * apart.position);
}

TEST(TwoMassGain, InTheGapALighterCartFollowsItsReadingsMore) {
  TwoMassGain light(with_gap(0.3), {1e4, 0.003}, kPeriod_s, kViscous_per_s, kLine_m);
  TwoMassGain heavy(with_gap(0.7), {1e4, 0.003}, kPeriod_s, kViscous_per_s, kLine_m);
  EXPECT_GT(settled(light, false).velocity_per_s, 1.5 * settled(heavy, false).velocity_per_s);
}

}  // namespace
}  // namespace cartwright
