#include "host/diagnose/search/explanation.hpp"

#include <algorithm>
#include <functional>

#include "host/diagnose/search/promises.hpp"

namespace cartwright {

double Explanation::score() const {
  const double numbers = static_cast<double>(fit.free.size()) + 2 * static_cast<double>(jumps.size());
  return fit.log_likelihood - kCostPerNumber * numbers;
}

bool Explanation::has(Term term) const {
  return std::find(effects.begin(), effects.end(), term) != effects.end();
}

bool Explanation::has_two_masses() const {
  return std::any_of(effects.begin(), effects.end(), two_masses);
}

std::size_t Explanation::effects_beyond_every_cart() const {
  const auto others = std::count_if(effects.begin(), effects.end(), std::not_fn(every_cart_has));
  return static_cast<std::size_t>(others);
}

bool every_cart_has(Term term) {
  return term == Term::viscous_friction || term == Term::coulomb_friction || term == Term::constant_force;
}

}  // namespace cartwright
