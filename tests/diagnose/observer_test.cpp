#include "host/diagnose/observe/observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/model/plant.hpp"

namespace cartwright {
namespace {

constexpr double kCoarse_m = 1e-4, kDamping_per_s = 5;

Model cart() {
  Model model(1.9);
  model.set(Parameter::viscous_coefficient, kDamping_per_s).set(Parameter::coulomb_level, 0.4);
  return model;
}

Rig rig(double sample_rate_hz) {
  Rig rig;
  rig.sample_rate_hz = sample_rate_hz;
  rig.encoder_resolution_m = kCoarse_m;
  return rig;
}

/// From rest, with 6 V from the first row on, read by a coarse encoder.
Recording pushed_from_rest(const Rig& rig) {
  Plant plant(cart(), {});
  plant.reset(0.3 * kCoarse_m, 0, 0);
  Recording r;
  for (double t_s = 0; t_s < 1; t_s += rig.period_s()) {
    r.t_s.push_back(t_s);
    r.u_V.push_back(6);
    r.y_m.push_back(kCoarse_m * std::round(plant.state().position_m / kCoarse_m));
    plant.advance(r.u_V.back(), rig.period_s());
  }
  return r;
}

double greatest_error_m(const Recording& r, const Rig& rig, std::size_t from) {
  const ObserverGains gains = observer_gains({}, rig.period_s(), kDamping_per_s);
  const Observation seen = observe(cart(), gains, rig, r);
  double most = 0;
  for (std::size_t k = from; k < seen.error_m.size(); ++k) most = std::max(most, std::abs(seen.error_m[k]));
  return most;
}

class Observer : public testing::TestWithParam<double> {};

TEST_P(Observer, HasSettledWhereErrorsCount) {
  const Rig one = rig(GetParam());
  EXPECT_LT(greatest_error_m(pushed_from_rest(one), one, settling_rows(one)), 1.1 * kCoarse_m);
}

TEST_P(Observer, TakesUpTheMotionBehindAGap) {
  const Rig one = rig(GetParam());
  Recording r = pushed_from_rest(one);
  const auto begin = static_cast<std::ptrdiff_t>(0.4 * one.sample_rate_hz);
  const auto end = static_cast<std::ptrdiff_t>(0.5 * one.sample_rate_hz);
  for (auto* column : {&r.t_s, &r.u_V, &r.y_m}) column->erase(column->begin() + begin, column->begin() + end);
  const std::size_t behind = static_cast<std::size_t>(begin) + settling_rows(one);
  EXPECT_LT(greatest_error_m(r, one, behind), 1.1 * kCoarse_m);
}

TEST_P(Observer, AveragesOverNoMoreThanSomeTenRoundedReadings) {
  Rig one = rig(GetParam());
  for (const double correlation_s : {0.0003, 0.003, 0.03}) {
    const auto gain = [&] {
      return observer_gains(bounded({1, correlation_s}, one), one.period_s(), kDamping_per_s)
          .settled.position;
    };
    one.encoder_resolution_m = kCoarse_m;
    EXPECT_GT(gain(), 0.05);
    EXPECT_LT(gain(), 0.15);
    one.encoder_resolution_m = 0;
    EXPECT_LT(gain(), 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(Rates, Observer, testing::Values(200.0, 500.0, 1000.0, 4000.0));

}  // namespace
}  // namespace cartwright
