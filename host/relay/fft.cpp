#include "host/relay/fft.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "host/vector_clones.hpp"

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

/// Roots and work space of a size that a thread has transformed before: records of one length come in a row,
/// and both take longer to make than the transform itself.
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

using Floats = float __attribute__((vector_size(16)));
using FloatsAt = float __attribute__((vector_size(16), aligned(4), may_alias));

/// What a butterfly of four makes of its inputs; for numbers and for vectors of them.
template <typename T>
struct Butterfly {
  T r0, i0, r1, i1, r2, i2, r3, i3;

  Butterfly(const T& ar, const T& ai, const T& br, const T& bi, const T& cr, const T& ci, const T& dr,
            const T& di) {
    const T sum_r = ar + cr, sum_i = ai + ci, gap_r = ar - cr, gap_i = ai - ci;
    const T odd_r = br + dr, odd_i = bi + di;
    const T turn_r = di - bi, turn_i = br - dr;  // i (b - d)
    r0 = sum_r + odd_r, i0 = sum_i + odd_i;
    r1 = gap_r - turn_r, i1 = gap_i - turn_i;
    r2 = sum_r - odd_r, i2 = sum_i - odd_i;
    r3 = gap_r + turn_r, i3 = gap_i + turn_i;
  }
};

/// The first stage: nothing is interleaved yet, so that neighbouring butterflies stand side by side.
CARTWRIGHT_VECTOR_CLONES void radix4_first(std::size_t n, Roots w, const float* __restrict xr,
                                           const float* __restrict xi, float* __restrict yr,
                                           float* __restrict yi) {
  const std::size_t quarter = n / 4, w_step = w.order / n;
  for (std::size_t p = 0; p < quarter; ++p) {
    const Butterfly<float> b(xr[p], xi[p], xr[p + quarter], xi[p + quarter], xr[p + 2 * quarter],
                             xi[p + 2 * quarter], xr[p + 3 * quarter], xi[p + 3 * quarter]);
    const float c1 = w.real[p * w_step], s1 = w.imaginary[p * w_step];
    const float c2 = w.real[2 * p * w_step], s2 = w.imaginary[2 * p * w_step];
    const float c3 = w.real[3 * p * w_step], s3 = w.imaginary[3 * p * w_step];
    yr[4 * p] = b.r0;
    yr[4 * p + 1] = b.r1 * c1 - b.i1 * s1;
    yr[4 * p + 2] = b.r2 * c2 - b.i2 * s2;
    yr[4 * p + 3] = b.r3 * c3 - b.i3 * s3;
    yi[4 * p] = b.i0;
    yi[4 * p + 1] = b.r1 * s1 + b.i1 * c1;
    yi[4 * p + 2] = b.r2 * s2 + b.i2 * c2;
    yi[4 * p + 3] = b.r3 * s3 + b.i3 * c3;
  }
}

/// The stages after it: transforms of length `n`, `stride` of them interleaved.
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
    for (std::size_t q = 0; q < stride; q += 4) {
      const auto in = [q](const float* at) { return reinterpret_cast<const FloatsAt*>(at + q); };
      const auto out = [q](float* at) { return reinterpret_cast<FloatsAt*>(at + q); };
      const Butterfly<Floats> b(*in(ar), *in(ai), *in(ar + hop), *in(ai + hop), *in(ar + 2 * hop),
                                *in(ai + 2 * hop), *in(ar + 3 * hop), *in(ai + 3 * hop));
      *out(er) = b.r0;
      *out(ei) = b.i0;
      *out(er + stride) = b.r1 * c1 - b.i1 * s1;
      *out(ei + stride) = b.r1 * s1 + b.i1 * c1;
      *out(er + 2 * stride) = b.r2 * c2 - b.i2 * s2;
      *out(ei + 2 * stride) = b.r2 * s2 + b.i2 * c2;
      *out(er + 3 * stride) = b.r3 * c3 - b.i3 * s3;
      *out(ei + 3 * stride) = b.r3 * s3 + b.i3 * c3;
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

/// Even samples to the real part, odd ones to the imaginary.
CARTWRIGHT_VECTOR_CLONES void pack(const float* __restrict samples, std::size_t pairs, float* __restrict xr,
                                   float* __restrict xi) {
  for (std::size_t j = 0; j < pairs; ++j) {
    xr[j] = samples[2 * j];
    xi[j] = samples[2 * j + 1];
  }
}

/// The spectrum of the real samples, bins 1 to n - 1, from that of the packed ones: even samples
/// E = (Z_k + conj Z_(n-k))/2, odd samples O = (Z_k - conj Z_(n-k))/(2i), Y = E + w^k O.
CARTWRIGHT_VECTOR_CLONES void unpack(std::size_t n, Roots w, const float* __restrict xr,
                                     const float* __restrict xi, float* __restrict real,
                                     float* __restrict imaginary) {
  for (std::size_t k = 1; k < n; ++k) {
    const std::size_t b = n - k;
    const float even_r = 0.5F * (xr[k] + xr[b]), even_i = 0.5F * (xi[k] - xi[b]);
    const float odd_r = 0.5F * (xi[k] + xi[b]), odd_i = -0.5F * (xr[k] - xr[b]);
    real[k] = even_r + w.real[k] * odd_r - w.imaginary[k] * odd_i;
    imaginary[k] = even_i + w.real[k] * odd_i + w.imaginary[k] * odd_r;
  }
}

}  // namespace

Spectrum real_spectrum(const std::vector<float>& samples, std::size_t size) {
  // Two sizes take turns over a record: the padded one that looks for peaks, and that of what is left.
  static thread_local std::array<Plan, 2> plans;
  if (plans[0].size != size) std::swap(plans[0], plans[1]);
  Plan& plan = plans[0];
  plan.prepare(size);
  const std::size_t n = size / 2;
  float* xr = plan.xr.data();
  float* xi = plan.xi.data();
  float* yr = plan.yr.data();
  float* yi = plan.yi.data();
  const Roots roots{plan.wr.data(), plan.wi.data(), size};
  const std::size_t given = std::min(samples.size(), size);
  pack(samples.data(), given / 2, xr, xi);
  std::fill(xr + given / 2, xr + n, 0.0F);
  std::fill(xi + given / 2, xi + n, 0.0F);
  if (given % 2 == 1) xr[given / 2] = samples[given - 1];
  std::size_t stride = 1;
  for (std::size_t length = n; length > 1;) {
    if (length >= 4 && stride == 1) {
      radix4_first(length, roots, xr, xi, yr, yi);
      length /= 4;
      stride *= 4;
    } else if (length >= 4) {
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
  Spectrum out;
  out.real.resize(n + 1);
  out.imaginary.resize(n + 1);
  out.real[0] = xr[0] + xi[0];
  out.real[n] = xr[0] - xi[0];
  unpack(n, roots, xr, xi, out.real.data(), out.imaginary.data());
  return out;
}

}  // namespace cartwright
