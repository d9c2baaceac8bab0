#include "host/diagnose/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace cartwright {

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
    out.push_back(
        "What is missing differs between recordings: another cart, load or setting, or one that changed.");
  }
  const auto& list = session.recordings;
  if (list.size() == 1) out.push_back("One recording only: nothing could be held out.");
  if (std::none_of(list.begin(), list.end(), [](const Recording& r) { return !r.repeat_of.empty(); })) {
    out.push_back("No repeats: the noise floor rests on the fitted noise alone.");
  }
  const auto foreign =
      std::count_if(list.begin(), list.end(), [](const Recording& r) { return !r.has_controller(); });
  if (foreign > 0) {
    out.push_back(
        fmt::format("{} of {} recordings come without a control law: judged from the recorded voltage.",
                    foreign, list.size()));
  }
  return out;
}

}  // namespace cartwright
