#include "host/diagnose/judge/predicts_no_better.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "host/diagnose/judge/prediction_errors.hpp"
#include "host/diagnose/judge/statement.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

constexpr double kClearlyWorse = 1.5;
constexpr double kSure = 0.95;

/// Whether windows are predicted worse than by the nominal model, window by window beyond chance, and by
/// half.
bool clearly_worse(const WindowErrors& windows) {
  const std::size_t n = windows.nominal.size();
  if (n < 3) return false;
  Eigen::ArrayXd more(n);  // mean squares of each window, with effects less nominal
  for (std::size_t i = 0; i < n; ++i) {
    const SquaredError &with = windows.with_effects[i], &nominal = windows.nominal[i];
    more[static_cast<Eigen::Index>(i)] =
        (with.sum_m2 - nominal.sum_m2) / static_cast<double>(std::max<std::size_t>(1, with.rows));
  }
  const double degrees = static_cast<double>(n - 1);
  const double spread = std::sqrt((more - more.mean()).square().sum() / degrees / static_cast<double>(n));
  return rms_m(windows.with_effects) > kClearlyWorse * rms_m(windows.nominal) &&
         more.mean() > student_t(kSure, degrees) * spread;
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
