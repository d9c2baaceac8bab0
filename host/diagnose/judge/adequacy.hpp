#pragma once

#include "host/diagnose/diagnosis.hpp"

namespace cartwright {

/// What an explanation may leave of the excess error of the windows, where what is left is beyond chance.
inline constexpr double kMostLeftOfWindows = 0.2;

/// And of the likelihood to be gained.
inline constexpr double kMostLeftOfLikelihood = 0.4;

/// Share of the excess of the window errors, above the floor, that the effects leave; 1 where there is no
/// excess.
double excess_left(const Errors& errors, double floor_m);

/// What a fit would gain that explained the structure that is left [nats].
double nats_left(const Location& after);

/// Share of the likelihood to be gained that the best explanation leaves.
double likelihood_left(const Location& after, const Search& search);

/// Whether an explanation leaves too much to be given names, by these shares. A likelihood is a logarithm:
/// the greater an effect, the more of it lies in the form of its law. So of a single effect that most of
/// several recordings show it may leave more, where windows hardly show that.
bool too_much_left(double of_windows, double of_likelihood, const std::vector<Support>& effects);

}  // namespace cartwright
