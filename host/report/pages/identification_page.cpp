#include "host/report/pages/identification_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/identify/identify.hpp"
#include "host/report/pages/damping.hpp"
#include "host/report/pages/friction_curve.hpp"
#include "host/report/pages/gain_pairs.hpp"
#include "host/report/pages/limit_cycles.hpp"
#include "host/report/pages/model_fit.hpp"
#include "host/report/pages/parameters.hpp"
#include "host/report/pages/summary.hpp"
#include "host/report/session_page.hpp"

namespace cartwright::report {
namespace {

constexpr Colour kModelColours[] = {Colour::model, Colour::other_model, Colour::fourth, Colour::warning};

constexpr const char* kFromOneStep = "one step, six intervals";
constexpr const char* kFromRelays = "relay tests";
constexpr const char* kFromVoltage = "all recordings";

/// The speed that nearly all rows stay below, from positions a few rows apart so that the encoder's steps do
/// not count as speed.
double usual_top_speed_m_per_s(const Session& session) {
  constexpr std::size_t kApart = 10;
  std::vector<double> speeds;
  for (const Recording& recording : session.recordings) {
    for (std::size_t i = kApart; i < recording.size(); i += kApart) {
      speeds.push_back(std::abs(recording.y_m[i] - recording.y_m[i - kApart]) /
                       (recording.t_s[i] - recording.t_s[i - kApart]));
    }
  }
  if (speeds.empty()) return 1;
  const auto high = speeds.begin() + static_cast<std::ptrdiff_t>(0.995 * static_cast<double>(speeds.size()));
  std::nth_element(speeds.begin(), high, speeds.end());
  return std::max(*high, 1e-3);
}

double total_time_s(const Session& session) {
  double sum = 0;
  for (const Recording& recording : session.recordings) sum += recording.t_s.back() - recording.t_s.front();
  return sum;
}

void add_what_was_run(Report& page, const IdentificationPage& content) {
  const Rig& rig = content.session.rig;
  page.section("What was run");
  page.facts({{"Rig", rig.name},
              {"Recordings", fmt::format("{}, {:.1f} s in all", content.session.recordings.size(),
                                         total_time_s(content.session))},
              {"Sample rate", fmt::format("{} Hz", rig.sample_rate_hz)},
              {"Encoder", fmt::format("{:.4g} µm per count", 1e6 * rig.encoder_resolution_m)},
              {"Voltage limit", fmt::format("±{:.4g} V", rig.voltage_limit_V)},
              {"Session", content.source},
              {"Made by", "cartwright " CARTWRIGHT_VERSION}});
  page.table(recordings_table(content.session));
}

bool has_relay_tests(const Session& session) {
  return std::any_of(session.recordings.begin(), session.recordings.end(), [](const Recording& recording) {
    return std::holds_alternative<DualRelayGains>(recording.controller);
  });
}

/// A model of what the relay tests tell apart.
Model model_of(const RelayReport& relay) {
  Model model;
  for (const RelayReport::Value& value : relay.parameters) {
    if (const auto parameter = find_parameter(value.name)) model.set(*parameter, value.estimate.value);
  }
  return model;
}

ParameterColumn column_of(const RelayReport& relay) {
  ParameterColumn column{kFromRelays, {}};
  for (const RelayReport::Value& value : relay.parameters) {
    if (const auto parameter = find_parameter(value.name)) column.values[*parameter] = value.estimate;
  }
  return column;
}

template <typename Found>
ParameterColumn column_of(std::string heading, const Found& found) {
  ParameterColumn column{std::move(heading), {}};
  for (const ParameterEstimate& one : found.estimates) column.values[one.parameter] = one.estimate;
  return column;
}

/// The least that moves like a cart, from the recorded voltage: what any session can be asked, with or
/// without a known control law. Who gives models of their own has done that.
Result<Identification> from_voltage(const IdentificationPage& content) {
  if (!content.models.empty()) return failure("models were given");
  return TermSet::create({Term::viscous_friction, Term::coulomb_friction, Term::constant_force})
      .and_then([&](const TermSet& terms) { return identify(content.session, terms); });
}

std::string origin_of(const NamedModel& model, bool given, const Result<StepDamping>& step) {
  if (given) return "a file given to the report";
  if (model.name == kFromVoltage) return "the recorded voltage of all recordings, by the integral method";
  if (model.name == kFromRelays) return "limit cycles of the relay tests, matched in time";
  return step->piecewise.file + ", by the integral method";
}

}  // namespace

Report identification_page(const IdentificationPage& content) {
  const Session& session = content.session;
  const Result<RelayReport> relay =
      has_relay_tests(session) ? identify_from_relay(session) : failure("there are none");
  std::vector<NamedModel> models = content.models;
  std::vector<ParameterColumn> columns;
  for (const NamedModel& one : models) columns.push_back(column_of(one));
  const Result<Identification> recorded = from_voltage(content);
  if (recorded) {
    models.push_back({kFromVoltage, recorded->model});
    columns.push_back(column_of(kFromVoltage, *recorded));
  }
  const Result<StepDamping> step = step_damping(session);
  if (step) {
    // One step with constant damping is a stage on the way: it stands in the table, not in every plot.
    columns.push_back(column_of("one step, constant", step->constant));
    columns.push_back(column_of(kFromOneStep, step->piecewise));
  }
  if (relay) {
    models.push_back({kFromRelays, model_of(*relay)});
    columns.push_back(column_of(*relay));
  }
  if (step) models.push_back({kFromOneStep, step->piecewise.model});
  if (content.truth) columns.push_back(column_of("true", *content.truth));
  // The latest is the one that is looked at: it gets the first colour.
  for (std::size_t i = 0; i < models.size(); ++i) {
    models[models.size() - 1 - i].colour = kModelColours[i % std::size(kModelColours)];
  }

  std::vector<ModelOrigin> origins;
  for (const NamedModel& one : models) {
    const bool given = origins.size() < content.models.size();
    origins.push_back({one, origin_of(one, given, step)});
  }

  Report page{"Identification of " + session.rig.name};
  add_summary(page, session, origins, content.truth);
  add_what_was_run(page, content);
  page.section("Parameters");
  if (!recorded && content.models.empty())
    page.paragraph("Nothing from the recorded voltage of all recordings: " + recorded.error().message + ".");
  page.table(parameters_table("Every model side by side", columns));

  std::vector<NamedModel> curves = models;
  if (content.truth) curves.push_back({"true", *content.truth, Colour::truth});
  page.section("Friction against speed");
  page.plot(friction_curves(curves, usual_top_speed_m_per_s(session)));

  if (step) {
    add_damping(page, *step, content.truth);
  } else {
    page.section("Damping of one step response")
        .paragraph("Nothing from the integral method on one step: " + step.error().message + ".");
  }

  add_gain_pairs(page, session, models);
  if (relay) {
    add_limit_cycles(page, session, *relay, content.truth);
  } else {
    page.section("Limit cycles").paragraph("Nothing from relay tests: " + relay.error().message + ".");
  }

  page.section("Fit to every recording");
  const Predictions predictions = predict_all(session, models);
  add_fit_table(page, session, models, predictions);
  add_recordings(page, session, models, predictions);
  return page;
}

}  // namespace cartwright::report
