#pragma once

#include <array>
#include <cstddef>

#include "common/identify/moving_rows.hpp"
#include "common/model/plant_terms.hpp"

namespace cartwright {

/// The unknowns of the regression  y'' = beta u - c v - f sgn v.
inline constexpr std::size_t kOnlineUnknowns = 3;
using OnlineVector = std::array<double, kOnlineUnknowns>;

/// One equation of the weak form: means over a window, weighted with the bump.
struct WeakWindow {
  double response_m_per_s2 = 0;     ///< of y''
  OnlineVector x{};                 ///< of u, -v, -sgn v
  OnlineVector z{};                 ///< the same of the twin, where every row has one; else x
  double modelled_m_per_s2 = 0;     ///< of the acceleration that `terms` gives
  double drive_m_per_s2 = 0;        ///< of the share of the voltage in that
  bool without_instrument = false;  ///< a twin there should be is out of step: no equation for the regression
};

/// The integral method's windows as a stream. The test function p(t) = (1 - s^2)^3, s = (t - centre)/half,
/// runs over four overlapping windows; an interval between two rows adds to each
///
///     -(dy/dt) dp   to  integral p y'' dt,      (p0 + p1)/2 dt g   to  integral p g dt,
///
/// the offline sums of host/identify/weak_form.hpp to the letter: the voltage counts over its hold, jitter
/// does not matter, no start state is left. Windows touch neither gaps nor standstill, nor reversals:
/// smoothing blurs the moment of those, and friction jumps there (offline the fitted model is replayed to
/// find it; leaving them out costs a quarter of the windows and takes the bias of 0.05 % away). The work is
/// the same at every tick. No allocation, no exception.
class WeakWindows {
 public:
  static constexpr std::size_t kOverlap = 4;

  explicit WeakWindows(double window_s) : window_s_(window_s) {}

  void interrupt() noexcept { running_ = false; }

  /// Takes the next row; returns how many windows it completed (0 or 1 at any rate of 100 Hz and more).
  std::size_t push(const MovingRow& row, const PlantTerms& terms) noexcept;
  const WeakWindow& complete(std::size_t i) const noexcept { return complete_[i]; }

 private:
  struct Sum {
    double start_s = 0;
    WeakWindow sums;
    bool twin = true;
  };
  struct Interval {
    double from_s, to_s, slope_m_per_s, modelled_m_per_s2, drive_m_per_s2;
    OnlineVector x, z;
    bool twin, left_out;
  };

  Interval interval_to(const MovingRow& row, const PlantTerms& terms) const noexcept;
  double bump(double start_s, double t_s) const noexcept;
  void add(Sum& sum, const Interval& interval) const noexcept;
  void finish(Sum& sum) noexcept;

  double window_s_;
  bool running_ = false;
  MovingRow before_;
  std::array<Sum, kOverlap> open_{};
  std::array<WeakWindow, kOverlap> complete_{};
  std::size_t completed_ = 0;
};

}  // namespace cartwright
