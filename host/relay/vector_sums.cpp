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

float greatest(const float* a, std::size_t count) {
  constexpr std::size_t kSide = 4;
  using Floats = float __attribute__((vector_size(16)));
  using FloatsAt = float __attribute__((vector_size(16), aligned(4), may_alias));
  Floats most{};
  std::size_t i = 0;
  for (; i + kSide <= count; i += kSide) {
    const Floats now = *reinterpret_cast<const FloatsAt*>(a + i);
    most = now > most ? now : most;
  }
  float out = std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
  for (; i < count; ++i) out = std::max(out, a[i]);
  return out;
}

}  // namespace cartwright
