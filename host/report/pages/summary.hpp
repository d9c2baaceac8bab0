#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/report/pages/named_model.hpp"
#include "host/report/report.hpp"
#include "host/session/session.hpp"

namespace cartwright::report {

/// A model of the page and where it comes from, in words.
struct ModelOrigin {
  NamedModel model;
  std::string origin;
};

/// The first section: which models the page compares and where each comes from, how well each predicts steps
/// with gains it may never have seen, and how far its numbers are from the true ones where these are known.
void add_summary(Report& page, const Session& session, const std::vector<ModelOrigin>& models,
                 const std::optional<Model>& truth);

/// The greatest relative distance of a model's numbers from the true ones; none where they have other terms.
std::optional<double> farthest_from(const Model& truth, const Model& model);

}  // namespace cartwright::report
