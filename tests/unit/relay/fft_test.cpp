#include "host/relay/fft.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <random>

namespace cartwright {
namespace {

TEST(RealSpectrum, EqualsTheDefinitionForEverySize) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  for (std::size_t size = 4; size <= 1024; size *= 2) {
    for (const std::size_t given : {size / 2 - 1, size / 2, size}) {
      std::vector<float> samples(given);
      for (float& value : samples) value = normal(random);
      const Spectrum spectrum = real_spectrum(samples, size);
      for (std::size_t k = 0; k <= size / 2; ++k) {
        std::complex<double> sum = 0;
        for (std::size_t j = 0; j < given; ++j) {
          const double turn = static_cast<double>(j * k % size) / static_cast<double>(size);
          sum += static_cast<double>(samples[j]) * std::polar(1.0, -2 * std::numbers::pi * turn);
        }
        EXPECT_NEAR(static_cast<double>(spectrum.real[k]), sum.real(), 1e-4);
        EXPECT_NEAR(static_cast<double>(spectrum.imaginary[k]), sum.imag(), 1e-4);
      }
    }
  }
}

}  // namespace
}  // namespace cartwright
