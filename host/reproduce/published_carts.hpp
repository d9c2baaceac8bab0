#pragma once

#include <array>

#include "common/model/model.hpp"

namespace cartwright::reproduce {

/// Numbers of Wongvanich, Hann and Sirisena (2015). These are the published column; where a simulated cart is
/// needed, the non-linear model stands for the measured one, whose data is not public.
struct PublishedLinear {
  const char* equation;
  double kp_V_per_m;  ///< gain of the experiment it was identified from
  double c_per_s, beta_m_per_s2_V;

  Model model() const { return Model(beta_m_per_s2_V).set(Parameter::viscous_coefficient, c_per_s); }
};

/// Lm1, Lm2, Lm3.
inline constexpr std::array<PublishedLinear, 3> kPublishedLinear{{
    {"Eq. (64)", 60, 6.1520, 1.8545},
    {"Eq. (75)", 80, 5.4916, 1.7482},
    {"Eq. (76)", 100, 4.5866, 1.7866},
}};

struct PublishedNonlinear {
  const char* equation;
  double kp_V_per_m;
  double alpha1_per_s, alpha2_s_per_m, gamma_per_s, beta_m_per_s2_V;

  Model model() const {
    return Model(beta_m_per_s2_V)
        .set(Parameter::exponential_alpha1, alpha1_per_s)
        .set(Parameter::exponential_alpha2, alpha2_s_per_m)
        .set(Parameter::exponential_gamma, gamma_per_s);
  }
};

/// NLm1, NLm2, NLm3.
inline constexpr std::array<PublishedNonlinear, 3> kPublishedNonlinear{{
    {"Eq. (73)", 60, 17.3264, 13.1068, 5.9986, 1.9165},
    {"Eq. (77)", 80, 22.1357, 18.2233, 5.6035, 1.9180},
    {"Eq. (78)", 100, 15.2528, 5.9934, 3.7990, 1.9100},
}};

/// The non-linear model identified at a proportional gain: the cart as it was in the experiments with it.
inline Model cart_at(double kp_V_per_m) {
  for (const PublishedNonlinear& one : kPublishedNonlinear) {
    if (one.kp_V_per_m == kp_V_per_m) return one.model();
  }
  return kPublishedNonlinear.front().model();
}

/// Step of the reference in every experiment [m].
inline constexpr double kStep_m = 0.1;

/// Gains of Tables 1 and 2.
struct GainPair {
  double kp_V_per_m, kd_V_s_per_m;
};
inline constexpr std::array<GainPair, 8> kGainPairs{
    {{60, 0}, {60, 5}, {80, 0}, {80, 5}, {80, 10}, {100, 0}, {100, 5}, {100, 10}}};

}  // namespace cartwright::reproduce
