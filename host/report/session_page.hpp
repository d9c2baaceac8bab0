#pragma once

#include <optional>
#include <vector>

#include "host/report/report.hpp"
#include "host/session/session.hpp"

namespace cartwright::report {

/// A model's prediction of a recording, drawn over it.
struct Overlay {
  std::string name;
  Colour colour = Colour::model;
  std::vector<double> t_s, y_m, u_V;
};

/// "PD, 60 V/m, 3 V s/m": kind and gains; fully: also filter, hysteresis.
std::string describe(const ControllerSpec& controller);
std::string describe_fully(const ControllerSpec& controller);

/// Number of rows, length, and what is uneven about its times, in words.
std::string describe_times(const Recording& recording, double sample_rate_hz);

/// Rig and recordings of a session as a table.
Table recordings_table(const Session& session);

/// Position with reference, and voltage with what was added to it, on linked time axes.
std::vector<Plot> recording_plots(const Recording& recording, const std::vector<Overlay>& overlays = {});

}  // namespace cartwright::report
