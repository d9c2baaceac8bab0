#pragma once

#include <array>
#include <bitset>
#include <initializer_list>
#include <string>

#include "common/model/vocabulary.hpp"

namespace cartwright {

/// A cart model: its voltage gain and the terms that are present, with their numbers (contract:
/// vocabulary.hpp). A term is present once it is added or one of its parameters is set; absent terms have no
/// effect whatever their numbers.
class Model {
 public:
  Model();
  explicit Model(double voltage_gain_m_per_s2_V) : Model() {
    set(Parameter::voltage_gain, voltage_gain_m_per_s2_V);
  }

  bool has(Term term) const { return present_[static_cast<std::size_t>(term)]; }
  void add(Term term) { present_[static_cast<std::size_t>(term)] = true; }
  void remove(Term term) { present_[static_cast<std::size_t>(term)] = false; }

  double operator[](Parameter parameter) const { return values_[static_cast<std::size_t>(parameter)]; }

  /// Sets a number and adds the term it belongs to. Returns *this, so that a model reads as one expression.
  Model& set(Parameter parameter, double value);

  /// The recording that `external_disturbance` acts in: its file name, as in session.toml.
  std::string disturbance_recording;

 private:
  std::array<double, kParameterCount> values_{};
  std::bitset<kTermCount> present_;
};

/// `term.key`, or the key alone for the voltage gain.
std::string dotted_name(Parameter parameter);

}  // namespace cartwright
