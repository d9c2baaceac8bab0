#include "common/model/plant.hpp"

#include <gtest/gtest.h>

namespace cartwright {
namespace {

TEST(Plant, CoulombFrictionHoldsStillUpToItsLevel) {
  Plant plant(Model(2.0).set(Parameter::coulomb_level, 0.5));
  plant.reset(0.1);
  plant.advance(0.2499, 10.0);
  EXPECT_EQ(plant.state().position_m, 0.1);
  EXPECT_EQ(plant.state().velocity_m_per_s, 0.0);
  plant.advance(0.2501, 10.0);
  EXPECT_GT(plant.state().velocity_m_per_s, 0.0);
}

TEST(Plant, CoastsToTheDistanceThatFrictionAllows) {
  // Energy: v0^2/2 = level * distance, for any step size.
  for (const double step_s : {1e-4, 1e-3, 0.1}) {
    PlantOptions options;
    options.step_s = step_s;
    Plant plant(Model(2.0).set(Parameter::coulomb_level, 0.5), options);
    plant.reset(0, 0.3);
    for (int tick = 0; tick < 1000; ++tick) plant.advance(0, 1e-3);
    EXPECT_NEAR(plant.state().position_m, 0.3 * 0.3 / (2 * 0.5), 1e-9);
    EXPECT_EQ(plant.state().velocity_m_per_s, 0.0);
  }
}

}  // namespace
}  // namespace cartwright
