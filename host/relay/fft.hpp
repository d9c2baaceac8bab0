#pragma once

#include <cstddef>
#include <vector>

namespace cartwright {

/// Discrete Fourier transform of real samples, zero-padded to `size` (a power of two, at least 4):
///
///     Y_k = sum over j of y_j exp(-i 2 pi j k/size),   k = 0 ... size/2
///
/// Radix 4, self-sorting (Stockham), real and imaginary parts apart so that the inner loops vectorise; the
/// real input is packed into a complex transform of half the size. Single precision: it tells where a peak
/// is, to about 1e-6 of the largest one, and no result is taken from it.
struct Spectrum {
  std::vector<float> real, imaginary;
};

Spectrum real_spectrum(const std::vector<float>& samples, std::size_t size);

}  // namespace cartwright
