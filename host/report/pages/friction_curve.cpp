#include "host/report/pages/friction_curve.hpp"

#include <limits>

#include "common/model/plant_terms.hpp"

namespace cartwright::report {

Plot friction_curves(const std::vector<NamedModel>& models, double greatest_speed_m_per_s) {
  constexpr int kPoints = 401;
  Plot plot;
  plot.x = {"speed", "m/s"};
  plot.y = {"opposing acceleration", "m/s²"};
  plot.height_px = 300;
  for (const NamedModel& one : models) {
    const PlantTerms terms(one.model, false);
    Series curve{.name = one.name, .colour = one.colour};
    for (int i = 0; i < kPoints; ++i) {
      const double speed = greatest_speed_m_per_s * (2.0 * i / (kPoints - 1) - 1);
      curve.x.push_back(speed);
      // At rest friction takes any value up to its level: the line breaks there.
      curve.y.push_back(speed == 0
                            ? std::numeric_limits<double>::quiet_NaN()
                            : terms.damping(speed) + sign_of(speed) * terms.level(0, speed) - terms.constant);
    }
    plot.add(std::move(curve));
  }
  return plot;
}

}  // namespace cartwright::report
