#pragma once

#include "host/diagnose/diagnosis.hpp"

namespace cartwright {

/// What an explanation may leave of the excess error of the windows, where what is left is beyond chance.
inline constexpr double kMostLeftOfWindows = 0.2;

/// And of the likelihood to be gained, where windows show any of it: the greater an effect, the more of a
/// likelihood, which is a logarithm, lies in the form of its law.
inline constexpr double kMostLeftOfLikelihood = 0.4;

/// Share of the excess of the window errors, above the floor, that the effects leave; 1 where there is no
/// excess.
double excess_left(const Errors& errors, double floor_m);

/// What a fit would gain that explained the structure that is left [nats].
double nats_left(const Location& after);

/// Share of the likelihood to be gained that the best explanation leaves.
double likelihood_left(const Location& after, const Search& search);

/// Whether an explanation leaves too much to be given names, by these shares.
bool too_much_left(double of_windows, double of_likelihood);

}  // namespace cartwright
