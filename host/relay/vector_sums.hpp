#pragma once

#include <cstddef>

namespace cartwright {

/// Sum of a_i b_i in a fixed number of lanes, whatever the processor's vectors hold: quick, and the same bits
/// everywhere.
double sum_of_products(const double* a, const double* b, std::size_t count);

inline double sum_of_squares(const double* a, std::size_t count) {
  return sum_of_products(a, a, count);
}

double sum(const double* a, std::size_t count);

/// The greatest of numbers that are not below zero.
float greatest(const float* a, std::size_t count);

}  // namespace cartwright
