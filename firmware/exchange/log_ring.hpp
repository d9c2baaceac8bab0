#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/log/record.hpp"

namespace cartwright::firmware {

/// The last `capacity` rows of the log, preallocated and touched. One thread appends, any other may copy out
/// rows by their number (0 is the first since the start). Neither waits: a copy that the writer has overtaken
/// says so.
class LogRing {
 public:
  explicit LogRing(std::size_t capacity)
      : capacity_(capacity), cells_(std::vector<std::atomic<double>>(capacity * kLogColumns)) {
    for (auto& cell : cells_) cell.store(0, std::memory_order_relaxed);  // touches every page now
  }

  void append(const LogRecord& record) noexcept {
    const std::uint64_t row = rows_.load(std::memory_order_relaxed);
    const LogRow values = to_row(record);
    std::atomic<double>* const to = &cells_[(row % capacity_) * kLogColumns];
    // Release: whoever reads one of these values also sees that the rows before are complete.
    for (std::size_t i = 0; i < kLogColumns; ++i) to[i].store(values[i], std::memory_order_release);
    rows_.store(row + 1, std::memory_order_release);
  }

  std::size_t capacity() const noexcept { return capacity_; }
  /// Rows written since the start; also the number of the next one.
  std::uint64_t rows() const noexcept { return rows_.load(std::memory_order_acquire); }
  /// The oldest row that is safe from being overwritten by the append that may be under way.
  std::uint64_t first_row() const noexcept {
    const std::uint64_t total = rows();
    return total < capacity_ ? 0 : total - capacity_ + 1;
  }

  /// Copies rows [first, first + out.size()) and returns how many of them, counted from `first`, there are: 0
  /// when `first` is no longer or not yet held.
  std::size_t copy(std::uint64_t first, std::span<LogRow> out) const noexcept {
    const std::uint64_t total = rows();
    if (first < first_row() || first >= total) return 0;
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), total - first));
    for (std::size_t i = 0; i < count; ++i) {
      const std::atomic<double>* const from = &cells_[((first + i) % capacity_) * kLogColumns];
      for (std::size_t column = 0; column < kLogColumns; ++column) {
        out[i][column] = from[column].load(std::memory_order_acquire);
      }
    }
    return first < first_row() ? 0 : count;  // overtaken while copying
  }

 private:
  std::size_t capacity_;
  std::vector<std::atomic<double>> cells_;
  std::atomic<std::uint64_t> rows_{0};
};

}  // namespace cartwright::firmware
