#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/model/model.hpp"
#include "host/report/pages/named_model.hpp"
#include "host/report/report.hpp"
#include "host/session/session.hpp"

namespace cartwright::report {

/// What goes into the page of an identification.
struct IdentificationPage {
  Session session;
  std::vector<NamedModel> models;  ///< shown beside the identified ones
  std::optional<Model> truth;      ///< what a simulated cart was made of
  std::string source;              ///< where the session came from, in words
};

/// The page: what was run, on what; parameters side by side; friction against speed; prediction of every gain
/// pair; errors and overlays of every recording.
Report identification_page(const IdentificationPage& content);

}  // namespace cartwright::report
