#pragma once

#include <cstddef>

/// Compiles a function twice, for any processor and for one with 256-bit vectors; the faster one that runs
/// here is chosen when the program starts. Used on loops that keep their partial sums in a fixed number of
/// lanes, so that both give the same bits. Sanitizers cannot run the selection, which happens before they are
/// set up.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CARTWRIGHT_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define CARTWRIGHT_VECTOR_CLONES
#endif

namespace cartwright {

/// Four numbers side by side, in as many registers as the processor needs for them. `LanesAt` is the same in
/// memory, at any address: `Lanes v = *reinterpret_cast<const LanesAt*>(p)`.
using Lanes = double __attribute__((vector_size(32)));
using LanesAt = double __attribute__((vector_size(32), aligned(8), may_alias));
inline constexpr std::size_t kLanes = 4;

inline double total(const Lanes& v) {
  return (v[0] + v[2]) + (v[1] + v[3]);
}

}  // namespace cartwright
