#include "host/diagnose/judge/predicts_no_better.hpp"

#include <fmt/format.h>

#include "host/diagnose/judge/prediction_errors.hpp"
#include "host/diagnose/judge/statement.hpp"

namespace cartwright {
namespace {

constexpr double kClearlyWorse = 1.5;

/// Whether windows are predicted worse than by the nominal model, beyond chance and by half.
bool clearly_worse(const WindowErrors& windows) {
  return rms_m(windows.with_effects) > kClearlyWorse * rms_m(windows.nominal) &&
         worse_beyond_chance(windows.with_effects, windows.nominal);
}

std::string worse(std::string_view which, double with_m, double other_m, std::string_view than) {
  return fmt::format("{} are predicted worse ({}) than {} ({})", which, length_text(with_m), than,
                     length_text(other_m));
}

}  // namespace

std::string predicts_no_better(const Diagnosis& d, const WindowErrors& used, const WindowErrors& unseen) {
  constexpr std::string_view kNominal = "by the nominal model as it was given";
  if (d.search.contests.empty()) return "";
  if (d.used.with_effects > d.uniform_motion_m)
    return worse("windows", d.used.with_effects, d.uniform_motion_m, "by a cart that just keeps its speed");
  if (clearly_worse(unseen))
    return worse("windows of held-out recordings", rms_m(unseen.with_effects), rms_m(unseen.nominal),
                 kNominal);
  if (clearly_worse(used)) return worse("windows", rms_m(used.with_effects), rms_m(used.nominal), kNominal);
  return "";
}

}  // namespace cartwright
