#include "host/diagnose/judge/hygiene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/session/gaps.hpp"
#include "host/session/rate.hpp"

namespace cartwright {
namespace {

constexpr double kLeastTravel_counts = 3;
constexpr double kMostRateError = 0.05;
constexpr double kThroughout = 0.95;  // of the rows

double travel_m(const Recording& r) {
  const auto [low, high] = std::minmax_element(r.y_m.begin(), r.y_m.end());
  return *high - *low;
}

bool at_limit_throughout(const Recording& r, double limit_V) {
  const auto at_limit = std::count_if(r.u_V.begin(), r.u_V.end(),
                                      [&](double u) { return std::abs(u) >= limit_V * (1 - 1e-9); });
  return static_cast<double>(at_limit) >= kThroughout * static_cast<double>(r.size());
}

}  // namespace

Result<std::vector<std::string>> check_hygiene(const Session& session) {
  const Rig& rig = session.rig;
  std::vector<std::string> remarks;
  bool anything_moves = false;
  for (const Recording& r : session.recordings) {
    if (r.size() < 2)
      return failure(fmt::format("{}: {} rows; a recording needs at least two", r.file, r.size()));
    const auto rate = check_rate(r, rig, kMostRateError, r.file);
    if (!rate) return tl::unexpected(rate.error());
    const bool moves = travel_m(r) > kLeastTravel_counts * rig.encoder_resolution_m;
    anything_moves = anything_moves || moves;
    if (!moves) {
      remarks.push_back(
          fmt::format("{}: the reading never moves by more than {:.0f} counts; it shows no motion.", r.file,
                      kLeastTravel_counts));
    } else if (at_limit_throughout(r, rig.voltage_limit_V)) {
      remarks.push_back(
          fmt::format("{}: u_V sits at its limit throughout; it excites next to nothing.", r.file));
    }
  }
  if (!anything_moves) {
    return failure(
        "y_m never moves in any recording: there is no motion to compare a model with; check encoder, "
        "amplifier and channel map");
  }
  for (const std::string& line : gaps_in_words(session)) remarks.push_back(line + ".");
  return remarks;
}

}  // namespace cartwright
