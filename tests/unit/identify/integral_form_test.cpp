#include "host/identify/integral_form.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "host/identify/damping_law.hpp"

namespace cartwright {
namespace {

/// y'' + C(t) y' + k y = 0 by Runge-Kutta at a fine step, sampled at 1 kHz.
template <typename Damping>
std::pair<std::vector<double>, std::vector<double>> response(Damping&& damping, double k, double y0,
                                                             double v0, double duration_s,
                                                             double period_s = 1e-3) {
  std::vector<double> t_s, y_m;
  constexpr int kParts = 10;
  const double h = period_s / kParts;
  double y = y0, v = v0, t = 0;
  const auto rows = static_cast<int>(std::round(duration_s / period_s)) + 1;
  const auto rate = [&](double at, double yy, double vv) { return -damping(at) * vv - k * yy; };
  for (int row = 0; row < rows; ++row) {
    t_s.push_back(t);
    y_m.push_back(y);
    for (int part = 0; part < kParts; ++part) {
      const double a1 = rate(t, y, v);
      const double a2 = rate(t + h / 2, y + h / 2 * v, v + h / 2 * a1);
      const double a3 = rate(t + h / 2, y + h / 2 * (v + h / 2 * a1), v + h / 2 * a2);
      const double a4 = rate(t + h, y + h * (v + h / 2 * a2), v + h * a3);
      y += h * (v + h / 6 * (a1 + a2 + a3));
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
      t += h;
    }
  }
  return {t_s, y_m};
}

TEST(IntegralForm, RecoversASpringMassDamper) {
  const auto [t_s, y_m] = response([](double) { return 5.0; }, 110, 0.1, -0.3, 0.9);
  const ConstantFit fit = fit_constant({t_s, y_m, {}});
  EXPECT_NEAR(fit.damping_per_s, 5, 1e-3);
  EXPECT_NEAR(fit.stiffness, 110, 1e-2);
  EXPECT_NEAR(fit.start_m, 0.1, 1e-6);
  EXPECT_NEAR(fit.alpha_m_per_s, -0.3 + 5 * 0.1, 1e-3);  // y' + c y
}

TEST(IntegralForm, OneIntervalIsTheConstantForm) {
  const auto [t_s, y_m] = response([](double t) { return 4 + 3 * t; }, 110, 0.1, 0, 0.9);
  const ConstantFit constant = fit_constant({t_s, y_m, {}});
  const PiecewiseFit piecewise = PiecewiseForm({t_s, y_m, {}}, 1).fit();
  EXPECT_NEAR(piecewise.damping_per_s[0], constant.damping_per_s, 1e-7);
  EXPECT_NEAR(piecewise.stiffness, constant.stiffness, 1e-6);
}

TEST(IntegralForm, RecoversPiecewiseDamping) {
  const std::vector<double> truth{4, 6, 5, 9, 12, 15};
  const auto [t_s, y_m] =
      response([&](double t) { return truth[std::min<std::size_t>(5, static_cast<std::size_t>(t / 0.15))]; },
               110, 0.1, 0, 0.9);
  const PiecewiseFit fit = PiecewiseForm({t_s, y_m, {}}, 6).fit();
  EXPECT_NEAR(fit.stiffness, 110, 0.2);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(fit.damping_per_s[i], truth[i], 0.1) << i;
}

TEST(IntegralForm, ThePredictionIsSmoothAcrossIntervals) {
  // C1 continuity holds for any data, also where the model is wrong: steps of value and slope stay at sample
  // size.
  const auto [t_s, y_m] = response([](double t) { return 3 + 20 * t * t; }, 110, 0.1, 0, 0.9);
  const PiecewiseForm form({t_s, y_m, {}}, 6);
  const std::vector<double> fitted_m = form.predict(form.fit().unknowns);
  for (std::size_t i = 1; i < 6; ++i) {
    const std::size_t at = form.boundaries()[i];
    const double before = fitted_m[at - 1] - fitted_m[at - 2], across = fitted_m[at] - fitted_m[at - 1],
                 after = fitted_m[at + 1] - fitted_m[at];
    EXPECT_NEAR(across, 0.5 * (before + after), 2e-5 * 0.1);
  }
}

TEST(IntegralForm, TheHeldVoltageTakesThePlaceOfTheSpring) {
  // y'' = 1.9 u - 5 y', u held: solved exactly row by row.
  std::vector<double> t_s, y_m, minus_u_V;
  double y = 0.02, v = 0.1;
  for (int row = 0; row < 1500; ++row) {
    const double t = 1e-3 * row + 2e-5 * std::sin(row),
                 u = 4 * std::sin(7 * t) + (row / 200 % 2 == 0 ? 2 : -2);
    t_s.push_back(t);
    y_m.push_back(y);
    minus_u_V.push_back(-u);
    const double h = 1e-3 * (row + 1) + 2e-5 * std::sin(row + 1) - t, settled = 1.9 * u / 5,
                 decay = std::exp(-5 * h);
    y += settled * h + (v - settled) * (1 - decay) / 5;
    v = settled + (v - settled) * decay;
  }
  const ConstantFit fit = fit_constant({t_s, y_m, minus_u_V});
  EXPECT_NEAR(fit.stiffness, 1.9, 1e-4);
  EXPECT_NEAR(fit.damping_per_s, 5, 5e-4);
  const PiecewiseFit pieces = PiecewiseForm({t_s, y_m, minus_u_V}, 5).fit();
  EXPECT_NEAR(pieces.stiffness, 1.9, 1e-3);
  for (const double damping_per_s : pieces.damping_per_s) EXPECT_NEAR(damping_per_s, 5, 0.02);
}

TEST(IntegralForm, ConstraintsHoldAndAreOptimal) {
  const auto [t_s, y_m] = response([](double t) { return 9 - 4 * t; }, 110, 0.1, 0, 0.9);
  const PiecewiseForm form({t_s, y_m, {}}, 6);
  DampingConstraints rising;
  rising.least_rise_per_s = 0.5;
  const PiecewiseFit monotone = form.fit(rising);
  for (std::size_t i = 1; i < 6; ++i) {
    EXPECT_GE(monotone.damping_per_s[i] - monotone.damping_per_s[i - 1], 0.5 - 1e-6);
  }
  EXPECT_LT(monotone.solution.kkt.greatest(), 1e-8);
  EXPECT_TRUE(monotone.solution.converged);
  DampingConstraints slow;
  slow.greatest_slope_per_s2 = 2;
  const PiecewiseFit bounded = form.fit(slow);
  for (std::size_t i = 1; i < 6; ++i) {
    EXPECT_LE(std::abs(bounded.damping_per_s[i] - bounded.damping_per_s[i - 1]), 2 * 0.15 + 1e-6);
  }
  EXPECT_LT(bounded.solution.kkt.greatest(), 1e-8);
}

TEST(IntegralForm, ASlopeOfZeroIsConstantDamping) {
  const auto [t_s, y_m] = response([](double t) { return 4 + 3 * t; }, 110, 0.1, 0, 0.9);
  DampingConstraints flat;
  flat.greatest_slope_per_s2 = 0;
  const PiecewiseFit fit = PiecewiseForm({t_s, y_m, {}}, 6).fit(flat);
  for (const double damping_per_s : fit.damping_per_s) EXPECT_NEAR(damping_per_s, fit.damping_per_s[0], 1e-5);
}

TEST(IntegralForm, ConvergesToTheTrueDampingUnderTheSlopeBound) {
  // Corollary 2 on the paper's example, Eq. (30)-(32): F = 0.9 + 0.7 t, K = 30; more intervals, smaller
  // error. The first and last intervals are the least certain, so the mean over the intervals is looked at.
  const auto truth = [](double t) { return 0.9 + 0.7 * t; };
  const auto [t_s, y_m] = response(truth, 30, 2, -1, 0.55);
  double last = 1, last_stiffness = 1;
  for (const std::size_t n : {2u, 11u, 50u}) {
    DampingConstraints bound;
    bound.greatest_slope_per_s2 = 0.7;
    const PiecewiseFit fit = PiecewiseForm({t_s, y_m, {}}, n).fit(bound);
    double mean = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double middle_s = 0.55 * (static_cast<double>(i) + 0.5) / static_cast<double>(n);
      mean += std::abs(fit.damping_per_s[i] - truth(middle_s)) / static_cast<double>(n);
    }
    EXPECT_LT(mean, 0.7 * last) << n;
    EXPECT_LT(std::abs(fit.stiffness - 30), 0.7 * last_stiffness) << n;
    last = mean;
    last_stiffness = std::abs(fit.stiffness - 30);
  }
}

TEST(DampingLaw, RecoversAnExponential) {
  const DampingLaw truth{17.3, 13.1, 6.0};
  std::vector<double> speeds{0.05, 0.1, 0.2, 0.3, 0.45, 0.6}, damping;
  for (const double v : speeds) damping.push_back(truth.at(v));
  const auto law = fit_damping_law(speeds, damping);
  ASSERT_TRUE(law) << law.error().message;
  EXPECT_NEAR(law->alpha1_per_s, 17.3, 0.02);
  EXPECT_NEAR(law->alpha2_s_per_m, 13.1, 0.02);
  EXPECT_NEAR(law->gamma_per_s, 6.0, 0.01);
}

TEST(DampingLaw, DampingThatRisesWithSpeedIsRefused) {
  const std::vector<double> speeds{0.1, 0.2, 0.3}, rising{5, 6, 8}, negative{5, 2, -1};
  EXPECT_FALSE(fit_damping_law(speeds, rising));
  EXPECT_FALSE(fit_damping_law(speeds, negative));
  EXPECT_FALSE(fit_damping_law(std::vector<double>{0.1, 0.2}, std::vector<double>{6, 5}));
}

}  // namespace
}  // namespace cartwright
