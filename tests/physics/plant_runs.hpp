#pragma once

#include "common/model/plant.hpp"

namespace cartwright::test {

inline Plant plant_at(const Model& model, double position_m, double velocity_m_per_s = 0,
                      const PlantOptions& options = {}) {
  Plant plant(model, options);
  plant.reset(position_m, velocity_m_per_s);
  return plant;
}

/// Holds a command over whole ticks of a millisecond.
inline void run(Plant& plant, double command_V, double duration_s) {
  constexpr double kTick_s = 1e-3;
  const int ticks = static_cast<int>(duration_s / kTick_s + 0.5);
  for (int tick = 0; tick < ticks; ++tick) plant.advance(command_V, kTick_s);
}

inline double speed_after(const Model& model, double command_V, double duration_s) {
  Plant plant = plant_at(model, 0);
  run(plant, command_V, duration_s);
  return plant.state().velocity_m_per_s;
}

}  // namespace cartwright::test
