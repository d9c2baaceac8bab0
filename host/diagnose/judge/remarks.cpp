#include "host/diagnose/judge/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cartwright {
namespace {

/// The name of the bin that stands farthest above chance.
std::string strongest_bin(const AxisMap& map) {
  std::size_t strongest = 0;
  const auto above_chance = [&](std::size_t i) {
    return map.band_m_per_s2[i] > 0 ? std::abs(map.push_m_per_s2[i]) / map.band_m_per_s2[i] : 0.0;
  };
  for (std::size_t i = 1; i < map.names.size(); ++i) {
    if (above_chance(i) > above_chance(strongest)) strongest = i;
  }
  return map.names[strongest];
}

}  // namespace

std::vector<std::string> remarks(const Session& session, const Model& nominal,
                                 const std::vector<Parameter>& held, const Diagnosis& diagnosis) {
  std::vector<std::string> out;
  for (const Parameter id : held)
    out.push_back(fmt::format("{} was held at {:.6g}, as given.", dotted_name(id), nominal[id]));
  const double found = diagnosis.search.refitted.fit.model[Parameter::voltage_gain];
  if (found * nominal[Parameter::voltage_gain] < 0) {
    out.push_back(
        "The cart moves against the voltage: the sign of y_m or of u_V, or the wiring, is reversed.");
  }
  if (diagnosis.unexplained && diagnosis.unexplained->axis == "recording") {
    out.push_back(fmt::format(
        "What is missing differs between recordings, most in {}: another cart, load or setting, or one that "
        "changed.",
        strongest_bin(diagnosis.unexplained->curve)));
  }
  const auto& list = session.recordings;
  if (list.size() == 1) out.push_back("One recording only: nothing could be held out.");
  if (std::none_of(list.begin(), list.end(), [](const Recording& r) { return !r.repeat_of.empty(); })) {
    out.push_back("No repeats: the noise floor rests on the fitted noise alone.");
  }
  const std::size_t foreign = session.without_law();
  if (foreign > 0) {
    out.push_back(
        fmt::format("{} of {} recordings come without a control law: judged from the recorded voltage.",
                    foreign, list.size()));
  }
  return out;
}

}  // namespace cartwright
