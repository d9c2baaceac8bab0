#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/report/plot.hpp"

namespace cartwright::report {

/// The most points one plot carries; beyond it the least and the greatest of each stretch are kept.
inline constexpr std::size_t kPointsPerPlot = 20000;

/// x and y of a line, thinned.
struct Thinned {
  std::vector<double> x, y;
};

/// Drops points that lie exactly on the line between their neighbours: a held reference needs two, not
/// thousands.
Thinned without_straight_runs(const std::vector<double>& x, const std::vector<double>& y);

/// At most about `budget` points: first, last, least and greatest of equal stretches, in their order. What a
/// screen can show stays the same; a single spike survives.
Thinned least_and_greatest(const std::vector<double>& x, const std::vector<double>& y, std::size_t budget);

/// The numbers of a page, each array once however many plots show it. Kept as a start in double and offsets
/// in single precision (base64, little-endian): 0.1 um on a metre, 10 us on a minute. An even grid is three
/// numbers.
class DataPool {
 public:
  /// Index of the array.
  std::size_t add(const std::vector<double>& values);

  /// One JSON array of all.
  std::string to_json() const;

 private:
  std::vector<std::string> arrays_;
  std::map<std::string, std::size_t> known_;
};

/// The plot as JSON for the page's script; its numbers go into the pool.
std::string to_json(const Plot& plot, DataPool& pool);

}  // namespace cartwright::report
