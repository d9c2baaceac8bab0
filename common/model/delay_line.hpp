#pragma once

#include <array>
#include <cstddef>

namespace cartwright {

/// Voltages on their way: each acts from the time it arrives until the next one does. Holds 0.1 s, the
/// longest delay of the vocabulary, at 5 kHz; a command that finds it full takes the place of the youngest.
/// No allocation.
class DelayLine {
 public:
  static constexpr std::size_t kCapacity = 512;

  void clear() noexcept { first_ = count_ = 0; }

  void push(double arrival_s, double voltage_V) noexcept {
    if (count_ == kCapacity) {
      line_[(first_ + count_ - 1) % kCapacity].voltage_V = voltage_V;
      return;
    }
    line_[(first_ + count_) % kCapacity] = {arrival_s, voltage_V};
    ++count_;
  }

  /// Whether a voltage arrives before a time.
  bool arrives_before(double time_s) const noexcept { return count_ > 0 && line_[first_].arrival_s < time_s; }
  double next_arrival_s() const noexcept { return line_[first_].arrival_s; }

  double pop() noexcept {
    const double voltage_V = line_[first_].voltage_V;
    first_ = (first_ + 1) % kCapacity;
    --count_;
    return voltage_V;
  }

 private:
  struct Entry {
    double arrival_s, voltage_V;
  };
  std::array<Entry, kCapacity> line_;
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace cartwright
