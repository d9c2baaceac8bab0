#pragma once

namespace cartwright {

/// Regularised incomplete beta function I_x(a, b), a, b > 0, x in [0, 1]; relative error below 1e-12.
/// (Continued fraction of Abramowitz and Stegun 26.5.8, evaluated by Lentz's method.)
double incomplete_beta(double a, double b, double x);

/// The x in [0, 1] with I_x(a, b) = p, for p in (0, 1). Newton's method inside a bracket that every step
/// tightens; where it would leave the bracket, the middle instead, so that it cannot fail.
double inverse_incomplete_beta(double a, double b, double p);

/// The z for which a normal variable lies within +-z standard deviations with this probability, below 1: 1.96
/// for 0.95.
double normal(double probability);

/// The t for which a Student variable with `degrees` degrees of freedom lies within +-t with this
/// probability: 1.96 for 0.95 and many degrees.
double student_t(double probability, double degrees);

/// The value an F variable with (numerator, denominator) degrees of freedom stays below with this
/// probability.
double f_quantile(double probability, double numerator, double denominator);

}  // namespace cartwright
