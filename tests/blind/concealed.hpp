#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/blind/cart.hpp"

namespace cartwright::blind {

/// How large an effect is; a medium one changes the motion about ten times as much as the encoder can tell.
enum class Size { third, small, medium, large };
std::string_view name(Size size);

/// What the cart is measured with.
struct Instruments {
  double sample_rate_hz = 1000, count_m = 2.275e-5;
  bool operator==(const Instruments&) const = default;
};

/// A cart drawn at random, what it hides, and what its owner believes.
struct Concealed {
  CartPhysics physics;
  std::vector<std::string>
      expected;  ///< names of the vocabulary; empty where nothing or nothing nameable is hidden
  std::map<std::string, double> truth;  ///< parameters of the effects, by their names in a model file
  // The nominal model: a few per cent off, with the terms its owner knows of.
  double nominal_gain_m_per_s2_V = 0, nominal_viscous_per_s = 0, nominal_coulomb_m_per_s2 = 0;
  bool nominal_has_coulomb = true;
};

/// Effects of the vocabulary that can be hidden; some of them by another law than its formula; and effects
/// that it has no name for: those the rules were made with, and those thought of once the rules stood.
const std::vector<std::string>& effects_of_the_vocabulary();
const std::vector<std::string>& effects_by_other_laws();
const std::vector<std::string>& effects_outside();
const std::vector<std::string>& effects_foreign();

/// A cart hiding `effects`, each of `size`; `parameter_change` and none at all are possible too.
Concealed draw(const std::vector<std::string>& effects, Size size, std::uint64_t seed,
               const Instruments& instruments);

}  // namespace cartwright::blind
