#include "host/diagnose/predicts_no_better.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <cmath>

#include "host/diagnose/prediction_errors.hpp"
#include "host/statistics/distributions.hpp"

namespace cartwright {
namespace {

constexpr double kClearlyWorse = 1.5;
constexpr double kSure = 0.95;

/// Whether the mean of `these` is greater than that of `those`, pair by pair, beyond chance and by half.
bool clearly_greater(const std::vector<double>& these, const std::vector<double>& those, double factor) {
  const std::size_t n = these.size();
  if (n < 3 || those.size() != n) return false;
  const Eigen::Map<const Eigen::ArrayXd> a(these.data(), static_cast<Eigen::Index>(n));
  const Eigen::Map<const Eigen::ArrayXd> b(those.data(), static_cast<Eigen::Index>(n));
  const Eigen::ArrayXd more = a - b;
  const double degrees = static_cast<double>(n - 1);
  const double spread = std::sqrt((more - more.mean()).square().sum() / degrees / static_cast<double>(n));
  return a.mean() > factor * b.mean() && more.mean() > student_t(kSure, degrees) * spread;
}

std::string worse(std::string_view which, double with_m, double other_m, std::string_view than) {
  return fmt::format("{} are predicted worse ({:.3g} mm) than {} ({:.3g} mm)", which, 1e3 * with_m, than,
                     1e3 * other_m);
}

}  // namespace

std::string predicts_no_better(const Diagnosis& d, const Model& nominal, const Session& used,
                               const Session& unseen, unsigned threads) {
  if (d.search.contests.empty()) return "";
  if (d.used.with_effects > d.uniform_motion_m)
    return worse("windows", d.used.with_effects, d.uniform_motion_m, "by a cart that just keeps its speed");
  const auto worse_than_nominal = [&](const Session& session) {
    return clearly_greater(window_mse_m2(d.search.best.fit.model, session, threads),
                           window_mse_m2(nominal, session, threads), kClearlyWorse * kClearlyWorse);
  };
  constexpr std::string_view kNominal = "by the nominal model as it was given";
  if (worse_than_nominal(unseen))
    return worse("windows of held-out recordings", d.held_out.with_effects, d.held_out.nominal, kNominal);
  if (worse_than_nominal(used)) return worse("windows", d.used.with_effects, d.used.nominal, kNominal);
  return "";
}

}  // namespace cartwright
