#pragma once

#include <functional>
#include <vector>

#include "host/design/scenarios.hpp"

namespace cartwright::design {

/// A range of one gain; one value where both ends are the same.
struct GainRange {
  double least = 0, most = 0;
  bool fixed() const { return least == most; }
};

/// The integral part goes with Kp through the integral time Ti, Ki = Kp/Ti, or is given; none for PD.
struct IntegralPart {
  double time_s = 0;        ///< Ti; zero for none
  double ki_V_per_m_s = 0;  ///< used where Ti is zero
};

struct MapPoint {
  Gains gains;
  bool tried = false;   ///< simulated with the model itself
  StepMetrics metrics;  ///< of that
  Verdict verdict;      ///< on that
  Trials::Worst worst;  ///< over the `mapped` scenarios; only where the model itself meets it
  bool holds() const { return tried && verdict.met() && worst.verdict.met(); }
};

/// Which gains meet a specification, over Kp and Kd: a lattice whose every fourth point is tried, and the
/// points between wherever the answer changes (for the model or for the worst scenario), is close, or is best
/// so far. What is not tried lies among equal neighbours. Nothing is assumed about the shape of the region; a
/// part of it smaller than four lattice steps may be missed.
class GainMap {
 public:
  using Progress = std::function<void(double)>;

  /// `quarters` coarse steps along each gain that is not fixed.
  GainMap(const Trials& trials, GainRange kp, GainRange kd, IntegralPart integral, std::size_t quarters,
          unsigned threads, const Progress& progress = {});

  std::size_t columns() const { return columns_; }  ///< along Kp
  std::size_t rows() const { return rows_; }        ///< along Kd
  const MapPoint& at(std::size_t column, std::size_t row) const { return points_[row * columns_ + column]; }
  const std::vector<MapPoint>& points() const { return points_; }
  GainRange kp() const { return kp_; }
  GainRange kd() const { return kd_; }
  IntegralPart integral() const { return integral_; }
  std::size_t tried() const;

  /// Slack of the model itself at every lattice point, row by row: where it was not tried, the mean of the
  /// surrounding points that were. Held within [-1, 1].
  std::vector<double> filled_slack() const;
  /// Likewise, 1 where the specification holds in every scenario.
  std::vector<char> filled_holds() const;

 private:
  void try_points(const std::vector<std::size_t>& which, const Trials& trials, unsigned threads);
  std::vector<std::size_t> worth_trying(std::size_t stride) const;
  template <typename Value, typename Of, typename Mean>
  std::vector<Value> filled(Of of, Mean mean) const;

  GainRange kp_, kd_;
  IntegralPart integral_;
  std::size_t columns_, rows_;
  std::vector<MapPoint> points_;
};

/// Closed outlines of a region on the lattice, along the sides of its cells: x along Kp, y along Kd and NaN
/// after each loop.
struct Outline {
  std::vector<double> x, y;
};
Outline outline(const GainMap& map, const std::vector<char>& inside);

}  // namespace cartwright::design
