#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace cartwright::firmware {

struct MultisineSetup {
  double amplitude = 1;  ///< greatest absolute value, in the unit of what it drives
  double low_hz = 0.125, high_hz = 2;
  int lines = 10;
  bool logarithmic = false;  ///< lines spread evenly in the logarithm of frequency instead of in frequency
  double duration_s = 8;
  double period_s = 1e-3;  ///< of the ticks at which the greatest value is taken
  std::uint32_t seed = 1;
};

/// s(t) = w(t) A sum_i sin(2 pi f_i t + phi_i) / peak, at lines f_i that are different multiples of
/// 1/duration (so that each is periodic in the recording) with phases drawn from a seed. w fades in and out
/// as a raised cosine over a sixteenth of the duration: it starts and ends at rest. `peak` is the greatest
/// value at a tick.
class Multisine {
 public:
  static constexpr std::size_t kMostLines = 32;

  Multisine() = default;
  /// Costs lines times ticks; not for the loop's thread.
  explicit Multisine(const MultisineSetup& setup);

  double at(double time_s) const noexcept;
  double duration_s() const noexcept { return duration_s_; }
  std::size_t lines() const noexcept { return lines_; }
  double frequency_hz(std::size_t line) const noexcept { return frequency_hz_[line]; }

 private:
  double sum(double time_s) const noexcept;

  std::array<double, kMostLines> frequency_hz_{}, phase_rad_{};
  std::size_t lines_ = 0;
  double scale_ = 0, duration_s_ = 0;
};

}  // namespace cartwright::firmware
