#include "host/report/pages/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/report/pages/gain_pairs.hpp"

namespace cartwright::report {
namespace {

/// Means over the pairs of gains of the error over 1 s, one for each model.
std::vector<double> mean_errors_m(const std::vector<GainPairError>& pairs, std::size_t models) {
  std::vector<double> out(models, 0.0);
  for (const GainPairError& pair : pairs) {
    for (std::size_t m = 0; m < models; ++m) out[m] += pair.over_1_s_m[m] / static_cast<double>(pairs.size());
  }
  return out;
}

}  // namespace

std::optional<double> farthest_from(const Model& truth, const Model& model) {
  double farthest = 0;
  for (const ParameterInfo& parameter : parameters()) {
    if (parameter.term && truth.has(*parameter.term) != model.has(*parameter.term)) return {};
    if (parameter.term && !truth.has(*parameter.term)) continue;
    const double exact = truth[parameter.id];
    if (exact != 0) farthest = std::max(farthest, std::abs(model[parameter.id] / exact - 1));
  }
  return farthest;
}

void add_summary(Report& page, const Session& session, const std::vector<ModelOrigin>& models,
                 const std::optional<Model>& truth) {
  if (models.empty()) return;
  std::vector<NamedModel> named;
  for (const ModelOrigin& one : models) named.push_back(one.model);
  const std::vector<GainPairError> pairs = gain_pair_errors(session, named);
  const std::vector<double> errors_m = mean_errors_m(pairs, models.size());

  page.section("In short");
  Table table;
  table.columns = {{"Model"}, {"Where it comes from"}};
  if (!pairs.empty()) table.columns.push_back({"Error of step responses", "mm"});
  if (truth) table.columns.push_back({"Farthest number from the truth", "%"});
  for (std::size_t m = 0; m < models.size(); ++m) {
    std::vector<Cell> cells{models[m].model.name, models[m].origin};
    if (!pairs.empty()) cells.push_back(Cell::number(1e3 * errors_m[m], 3));
    if (truth) {
      const auto farthest = farthest_from(*truth, models[m].model.model);
      cells.push_back(farthest ? Cell::number(100 * *farthest, 2) : Cell("other terms"));
    }
    table.row(std::move(cells));
  }
  if (!pairs.empty()) {
    table.note = fmt::format(
        "Mean absolute error over the second after a step, mean over {} pairs of gains; each pair below.",
        pairs.size());
  }
  page.table(table);
}

}  // namespace cartwright::report
