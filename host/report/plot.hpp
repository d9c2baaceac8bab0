#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cartwright::report {

struct Axis {
  std::string label{};
  std::string unit{};
  bool logarithmic = false;
  std::vector<std::string> categories{};      ///< names at 0, 1, 2, ... in the place of numbers
  std::optional<double> least{}, greatest{};  ///< the range to start with; from the data where absent
};

/// Colours that people with any colour vision, and a grey printer, can tell apart (after Okabe and Ito), by
/// the part they play, so that the same thing has the same colour in every plot. `automatic` takes the next
/// free one.
enum class Colour { automatic, measured, reference, model, other_model, truth, warning, fourth, muted };

enum class Mark {
  line,    ///< through the points; NaN breaks it
  step,    ///< each value held until the next, as a command is
  points,  ///< with error bars where `low` and `high` are given
  band,    ///< between `low` and `high`
  bars,    ///< from zero; side by side with other bars where an axis has categories
};

struct Series {
  std::string name{};
  std::vector<double> x{}, y{};
  Mark mark = Mark::line;
  Colour colour = Colour::automatic;
  std::vector<double> low{}, high{};  ///< band limits or error bars
  bool dashed = false;
  bool shown = true;  ///< at first; the legend turns it on and off
  double bar_width = 0.8;
};

/// Values on a regular grid: `values[row * columns + column]`, row 0 at the bottom; NaN is left blank.
struct HeatMap {
  std::string name{}, unit{};
  std::size_t columns = 0, rows = 0;
  double x_least = 0, x_greatest = 1, y_least = 0, y_greatest = 1;  ///< outer edges of the grid
  std::vector<double> values{};
  bool diverging = false;                     ///< two hues around zero; else one scale from light to dark
  std::optional<double> least{}, greatest{};  ///< limits of the colours; from the values where absent
};

/// A line across the plot at one value, named in the plot.
struct Guide {
  enum class Along { x, y } at = Along::x;
  double value = 0;
  std::string name{};
};

struct Plot {
  std::string title;
  std::string caption;
  Axis x, y;
  std::vector<Series> series;
  std::optional<HeatMap> heat_map;
  std::vector<Guide> guides;
  std::string linked;  ///< plots of one page with the same word here share their x range
  int height_px = 240;
  bool square = false;  ///< one unit is as long on both axes

  Series& add(Series one) { return series.emplace_back(std::move(one)); }
};

/// Counts of `values` in equal bins from the least to the greatest, as bars.
Series histogram(std::string name, const std::vector<double>& values, std::size_t bins);

}  // namespace cartwright::report
