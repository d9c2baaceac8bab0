#pragma once

#include "common/model/model.hpp"

namespace cartwright::design::test {

/// The models of Wongvanich, Hann and Sirisena, Eq. (76) and (78).
inline Model lm3() {
  Model model(1.7866);
  model.set(Parameter::viscous_coefficient, 4.5866);
  return model;
}

inline Model nlm3() {
  Model model(1.9100);
  model.set(Parameter::exponential_alpha1, 15.2528);
  model.set(Parameter::exponential_alpha2, 5.9934);
  model.set(Parameter::exponential_gamma, 3.7990);
  return model;
}

}  // namespace cartwright::design::test
