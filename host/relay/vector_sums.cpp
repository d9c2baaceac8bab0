#include "host/relay/vector_sums.hpp"

#include <algorithm>

#include "host/vector_clones.hpp"

namespace cartwright {

CARTWRIGHT_VECTOR_CLONES double sum_of_products(const double* a, const double* b, std::size_t count) {
  Lanes lanes{}, others{};  // two sums at a time, because one would wait for itself
  std::size_t i = 0;
  for (; i + 2 * kLanes <= count; i += 2 * kLanes) {
    lanes += *reinterpret_cast<const LanesAt*>(a + i) * *reinterpret_cast<const LanesAt*>(b + i);
    others +=
        *reinterpret_cast<const LanesAt*>(a + i + kLanes) * *reinterpret_cast<const LanesAt*>(b + i + kLanes);
  }
  lanes += others;
  for (; i < count; ++i) lanes[0] += a[i] * b[i];
  return total(lanes);
}

CARTWRIGHT_VECTOR_CLONES double sum(const double* a, std::size_t count) {
  Lanes lanes{}, others{};
  std::size_t i = 0;
  for (; i + 2 * kLanes <= count; i += 2 * kLanes) {
    lanes += *reinterpret_cast<const LanesAt*>(a + i);
    others += *reinterpret_cast<const LanesAt*>(a + i + kLanes);
  }
  lanes += others;
  for (; i < count; ++i) lanes[0] += a[i];
  return total(lanes);
}

CARTWRIGHT_VECTOR_CLONES float greatest(const float* a, std::size_t count) {
  constexpr std::size_t kSide = 8;
  using Floats = float __attribute__((vector_size(32)));
  using FloatsAt = float __attribute__((vector_size(32), aligned(4), may_alias));
  Floats most{}, others{};  // two at a time, because one would wait for itself
  std::size_t i = 0;
  for (; i + 2 * kSide <= count; i += 2 * kSide) {
    const Floats now = *reinterpret_cast<const FloatsAt*>(a + i);
    const Floats then = *reinterpret_cast<const FloatsAt*>(a + i + kSide);
    most = now > most ? now : most;
    others = then > others ? then : others;
  }
  most = others > most ? others : most;
  float out = 0;
  for (std::size_t lane = 0; lane < kSide; ++lane) out = std::max(out, most[lane]);
  for (; i < count; ++i) out = std::max(out, a[i]);
  return out;
}

}  // namespace cartwright
