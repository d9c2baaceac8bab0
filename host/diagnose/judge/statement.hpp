#pragma once

#include <string>
#include <vector>

#include "common/model/model.hpp"

namespace cartwright {

/// An effect as a sentence with its numbers and units.
std::string statement(Term term, const Model& model);

/// "lag, delay": terms by their names.
std::string names_of(const std::vector<Term>& terms);

struct Diagnosis;
struct Unexplained;

/// "57.3 um" below a millimetre, "1.22 mm" from there on.
std::string length_text(double length_m);

/// How well windows are predicted: as given, refitted, with what was found, and the noise floor.
std::string statement_of_windows(const Diagnosis& diagnosis);

/// How much stays unexplained, and along which axis, if any shows it.
std::string statement_of_left_over(const Unexplained& left);

struct Support;
/// "9 of 9 recordings say so, each beyond chance; without it windows would be 57.3 um off instead of 23.1
/// um."
std::string statement_of_support(const Support& support, double noise_floor_m);

struct NextExperiment;
/// "separates a lag from a delay; chance that it decides: 93 %." `more_is_missing`: besides those two.
std::string statement_of_next(const NextExperiment& next, bool more_is_missing);

/// That pushes with these periods stand above chance without a name; empty where there are none.
std::string statement_of_periods(const std::vector<double>& periods_m);

}  // namespace cartwright
