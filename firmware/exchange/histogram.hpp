#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace cartwright::firmware {

/// Counts durations in buckets that grow by a thirty-second of a power of two (at most 3.2 % wide), from 1 ns
/// to 68 s. One thread adds, others may read while it does. No allocation.
class Histogram {
 public:
  void add(std::int64_t duration_ns) noexcept {
    const auto value = static_cast<std::uint64_t>(std::max<std::int64_t>(duration_ns, 0));
    auto& bucket = buckets_[bucket_of(value)];
    bucket.store(bucket.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (value > greatest_.load(std::memory_order_relaxed)) greatest_.store(value, std::memory_order_relaxed);
  }

  /// The duration that the given part of all samples does not exceed: upper edge of its bucket; 0 without
  /// samples.
  double quantile_ns(double part) const noexcept {
    std::array<std::uint64_t, kBuckets> counts;
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      counts[i] = buckets_[i].load(std::memory_order_relaxed);
      total += counts[i];
    }
    const double wanted = part * static_cast<double>(total);
    double seen = 0;
    for (std::size_t i = 0; i < kBuckets; ++i) {
      seen += static_cast<double>(counts[i]);
      if (counts[i] > 0 && seen >= wanted) return std::min(upper_edge(i), greatest_ns());
    }
    return 0;
  }

  double greatest_ns() const noexcept {
    return static_cast<double>(greatest_.load(std::memory_order_relaxed));
  }

 private:
  static constexpr unsigned kFineBits = 5;
  static constexpr std::size_t kBuckets = 36U << kFineBits;

  static std::size_t bucket_of(std::uint64_t value) noexcept {
    if (value < (1U << kFineBits)) return static_cast<std::size_t>(value);
    const unsigned exponent = static_cast<unsigned>(std::bit_width(value)) - 1 - kFineBits;
    const std::size_t bucket = ((static_cast<std::size_t>(exponent) + 1) << kFineBits) +
                               static_cast<std::size_t>((value >> exponent) & ((1U << kFineBits) - 1));
    return std::min(bucket, kBuckets - 1);
  }

  static double upper_edge(std::size_t bucket) noexcept {
    if (bucket < (1U << kFineBits)) return static_cast<double>(bucket);
    const std::size_t exponent = (bucket >> kFineBits) - 1;
    const std::uint64_t fine = (bucket & ((1U << kFineBits) - 1)) + (1U << kFineBits);
    return static_cast<double>(((fine + 1) << exponent) - 1);
  }

  std::array<std::atomic<std::uint64_t>, kBuckets> buckets_{};
  std::atomic<std::uint64_t> greatest_{0};
};

}  // namespace cartwright::firmware
