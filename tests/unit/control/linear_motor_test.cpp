#include "host/reproduce/linear_motor.hpp"

#include <gtest/gtest.h>

namespace cartwright::reproduce {
namespace {

TEST(LinearMotor, IsThatOfTable1) {
  const Model motor = LinearMotor::model();
  EXPECT_NEAR(motor[Parameter::voltage_gain], 10.5 / (0.59 * 1.5), 1e-12);
  // Without friction the speed at a held voltage is the voltage over the back-EMF constant.
  const double speed = motor[Parameter::voltage_gain] / motor[Parameter::viscous_coefficient];
  EXPECT_NEAR(speed, 1 / (10.5 + 0.00062), 1e-12);
}

TEST(LinearMotor, CompensationCutsItsErrorByMoreThanPublished) {
  TrackingSetup setup = LinearMotor::tracking(CompensationMode::off, LinearMotor::model());
  setup.duration_s = 6;
  const double without = track(setup).measured_error_rms_m;
  setup.compensation.mode = CompensationMode::feed_forward;
  EXPECT_GT(without / track(setup).measured_error_rms_m, 11.2 / 1.01);
}

TEST(LinearMotor, ABetterStartOfTheAdaptiveLawIsBetter) {
  const auto section = adaptive_starts({});
  ASSERT_TRUE(section);
  ASSERT_GE(section->items.size(), 3U);
  double last = 1e9;
  for (std::size_t i = 0; i < 3; ++i) {
    const Item& item = section->items[i];
    const double early_mm = std::stod(item.obtained.substr(std::string("rms error ").size()));
    EXPECT_LT(early_mm, last);
    last = early_mm;
  }
}

}  // namespace
}  // namespace cartwright::reproduce
