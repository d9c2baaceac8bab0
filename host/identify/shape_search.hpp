#pragma once

#include <functional>
#include <vector>

#include "common/model/model.hpp"
#include "common/model/vocabulary.hpp"

namespace cartwright {

/// What the data spans: where a search for shapes has to look.
struct DataRange {
  double least_m = 0, most_m = 0;
  double speed_m_per_s = 0;
  double voltage_V = 0;
  double longest_s = 0;
  double period_s = 0;
};

/// Finds the values of `shapes` that minimise `cost`: a grid over each term's own shapes in turn, twice, then
/// a Nelder-Mead descent over all of them. Returns a model that holds them. `progress` hears which part of
/// the grids, nearly all of the work, is done.
Model search_shapes(const std::vector<Parameter>& shapes, const DataRange& range,
                    const std::function<double(const Model&)>& cost,
                    const std::function<void(double)>& progress = {});

}  // namespace cartwright
