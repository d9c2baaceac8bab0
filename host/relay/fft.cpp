#include "host/relay/fft.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/relay/vector_clones.hpp"

namespace cartwright {
namespace {

/// exp(-i 2 pi k/n) for k = 0 ... n - 1, as the product of a coarse and a fine table: 2 sqrt(n) sines instead
/// of n.
void roots_of_unity(std::size_t n, float* __restrict real, float* __restrict imaginary) {
  std::size_t fine = 1;
  while (fine * fine < n) fine *= 2;
  const double angle = -2 * std::numbers::pi / static_cast<double>(n);
  std::vector<double> c(fine), s(fine);
  for (std::size_t i = 0; i < fine; ++i) {
    c[i] = std::cos(angle * static_cast<double>(i));
    s[i] = std::sin(angle * static_cast<double>(i));
  }
  for (std::size_t block = 0; block < n; block += fine) {
    const double cb = std::cos(angle * static_cast<double>(block));
    const double sb = std::sin(angle * static_cast<double>(block));
    for (std::size_t i = 0; i < fine && block + i < n; ++i) {
      real[block + i] = static_cast<float>(cb * c[i] - sb * s[i]);
      imaginary[block + i] = static_cast<float>(cb * s[i] + sb * c[i]);
    }
  }
}

struct Roots {
  const float* real;
  const float* imaginary;
  std::size_t order;
};

/// Roots and work space of the last size a thread has transformed: records of one length come in a row, and
/// both take longer to make than the transform itself.
struct Plan {
  std::size_t size = 0;
  std::vector<float> wr, wi, xr, xi, yr, yi;

  void prepare(std::size_t wanted) {
    if (size != wanted) {
      size = wanted;
      wr.resize(size);
      wi.resize(size);
      roots_of_unity(size, wr.data(), wi.data());
      for (auto* work : {&xr, &xi, &yr, &yi}) work->resize(size / 2);
    }
  }
};

/// One radix-4 stage: transforms of length `n`, `stride` of them interleaved.
CARTWRIGHT_VECTOR_CLONES void radix4(std::size_t n, std::size_t stride, Roots w, const float* __restrict xr,
                                     const float* __restrict xi, float* __restrict yr, float* __restrict yi) {
  const std::size_t quarter = n / 4, w_step = w.order / n, hop = stride * quarter;
  for (std::size_t p = 0; p < quarter; ++p) {
    const float c1 = w.real[p * w_step], s1 = w.imaginary[p * w_step];
    const float c2 = w.real[2 * p * w_step], s2 = w.imaginary[2 * p * w_step];
    const float c3 = w.real[3 * p * w_step], s3 = w.imaginary[3 * p * w_step];
    const float* ar = xr + stride * p;
    const float* ai = xi + stride * p;
    float* er = yr + 4 * stride * p;
    float* ei = yi + 4 * stride * p;
    for (std::size_t q = 0; q < stride; ++q) {
      const float sum_r = ar[q] + ar[q + 2 * hop], sum_i = ai[q] + ai[q + 2 * hop];
      const float gap_r = ar[q] - ar[q + 2 * hop], gap_i = ai[q] - ai[q + 2 * hop];
      const float odd_r = ar[q + hop] + ar[q + 3 * hop], odd_i = ai[q + hop] + ai[q + 3 * hop];
      const float turn_r = ai[q + 3 * hop] - ai[q + hop],
                  turn_i = ar[q + hop] - ar[q + 3 * hop];  // i (b - d)
      er[q] = sum_r + odd_r;
      ei[q] = sum_i + odd_i;
      const float r1 = gap_r - turn_r, i1 = gap_i - turn_i;
      er[q + stride] = r1 * c1 - i1 * s1;
      ei[q + stride] = r1 * s1 + i1 * c1;
      const float r2 = sum_r - odd_r, i2 = sum_i - odd_i;
      er[q + 2 * stride] = r2 * c2 - i2 * s2;
      ei[q + 2 * stride] = r2 * s2 + i2 * c2;
      const float r3 = gap_r + turn_r, i3 = gap_i + turn_i;
      er[q + 3 * stride] = r3 * c3 - i3 * s3;
      ei[q + 3 * stride] = r3 * s3 + i3 * c3;
    }
  }
}

void radix2(std::size_t stride, const float* __restrict xr, const float* __restrict xi, float* __restrict yr,
            float* __restrict yi) {
  for (std::size_t q = 0; q < stride; ++q) {
    yr[q] = xr[q] + xr[q + stride];
    yi[q] = xi[q] + xi[q + stride];
    yr[q + stride] = xr[q] - xr[q + stride];
    yi[q + stride] = xi[q] - xi[q + stride];
  }
}

}  // namespace

Spectrum real_spectrum(const std::vector<float>& samples, std::size_t size) {
  static thread_local Plan plan;
  plan.prepare(size);
  const std::size_t n = size / 2;
  const float* wr = plan.wr.data();
  const float* wi = plan.wi.data();
  float* xr = plan.xr.data();
  float* xi = plan.xi.data();
  float* yr = plan.yr.data();
  float* yi = plan.yi.data();
  const Roots roots{wr, wi, size};
  const std::size_t given = std::min(samples.size(), size);
  for (std::size_t j = 0; j + 1 < given; j += 2) {
    xr[j / 2] = samples[j];
    xi[j / 2] = samples[j + 1];
  }
  std::fill(xr + given / 2, xr + n, 0.0F);
  std::fill(xi + given / 2, xi + n, 0.0F);
  if (given % 2 == 1) xr[given / 2] = samples[given - 1];
  std::size_t stride = 1;
  for (std::size_t length = n; length > 1;) {
    if (length >= 4) {
      radix4(length, stride, roots, xr, xi, yr, yi);
      length /= 4;
      stride *= 4;
    } else {
      radix2(stride, xr, xi, yr, yi);
      length /= 2;
      stride *= 2;
    }
    std::swap(xr, yr);
    std::swap(xi, yi);
  }
  // Unpack: even samples E = (Z_k + conj Z_(n-k))/2, odd samples O = (Z_k - conj Z_(n-k))/(2i), Y = E + w^k
  // O.
  Spectrum out;
  out.real.resize(n + 1);
  out.imaginary.resize(n + 1);
  out.real[0] = xr[0] + xi[0];
  out.real[n] = xr[0] - xi[0];
  for (std::size_t k = 1; k < n; ++k) {
    const std::size_t b = n - k;
    const float even_r = 0.5F * (xr[k] + xr[b]), even_i = 0.5F * (xi[k] - xi[b]);
    const float odd_r = 0.5F * (xi[k] + xi[b]), odd_i = -0.5F * (xr[k] - xr[b]);
    out.real[k] = even_r + wr[k] * odd_r - wi[k] * odd_i;
    out.imaginary[k] = even_i + wr[k] * odd_i + wi[k] * odd_r;
  }
  return out;
}

}  // namespace cartwright
