#include "tests/blind/baselines/sparse.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/blind/baselines/library.hpp"
#include "tests/blind/baselines/stlsq.hpp"

namespace cartwright::blind {
namespace {

constexpr std::size_t kHalfSmoothing = 5;  // ticks either side
constexpr std::size_t kRowEvery = 5;
constexpr std::size_t kHalfWindow = 50;
constexpr std::size_t kWindowEvery = 25;
constexpr double kRestSpan_s = 0.02;
constexpr double kRestCounts = 2;  // moved less than this in kRestSpan_s: at rest

std::vector<double> smoothed(const std::vector<double>& x) {
  std::vector<double> out(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) {
    const std::size_t half = std::min({kHalfSmoothing, k, x.size() - 1 - k});
    double sum = 0;
    for (std::size_t i = k - half; i <= k + half; ++i) sum += x[i];
    out[k] = sum / static_cast<double>(2 * half + 1);
  }
  return out;
}

/// What the library is evaluated on, tick by tick.
std::vector<Instant> instants(const Recording& r, const Rig& rig, const std::vector<double>& y,
                              const std::vector<double>& u) {
  const double period_s = rig.period_s();
  const auto ticks = [&](double time_s) { return static_cast<std::size_t>(std::lround(time_s / period_s)); };
  std::vector<Instant> all(r.size());
  double slow[2] = {};
  for (std::size_t k = 0; k < r.size(); ++k) {
    Instant& at = all[k];
    at.t_s = r.t_s[k] - r.t_s.front();
    at.y_m = y[k], at.u_V = u[k];
    const std::size_t back = std::min(k, kHalfSmoothing), on = std::min(kHalfSmoothing, r.size() - 1 - k);
    at.v_m_per_s = (y[k + on] - y[k - back]) / (r.t_s[k + on] - r.t_s[k - back]);
    for (int i = 0; i < 2; ++i) {
      const std::size_t late = ticks(i == 0 ? 0.002 : 0.004);
      at.u_late_V[i] = k >= late ? u[k - late] : 0;
      slow[i] += (1 - std::exp(-period_s / (i == 0 ? 0.002 : 0.005))) * (u[k] - slow[i]);
      at.u_slow_V[i] = slow[i];
    }
  }
  return all;
}

double least_speed_m_per_s(const Session& session) {
  return kRestCounts * session.rig.encoder_resolution_m / kRestSpan_s;
}

NormalEquations by_derivatives(const Session& session, const Recording& r, const Library& library) {
  const auto columns = static_cast<Eigen::Index>(library.size());
  NormalEquations sums(columns);
  const std::vector<double> y = smoothed(r.y_m);
  // A second difference over so many ticks is the acceleration under two more such means; the voltage about a
  // reading is that of the tick before and of the tick after.
  std::vector<double> u = r.u_V;
  for (std::size_t k = u.size() - 1; k > 0; --k) u[k] = 0.5 * (u[k] + u[k - 1]);
  const std::vector<Instant> at = instants(r, session.rig, y, smoothed(smoothed(smoothed(u))));
  const std::size_t reach = 2 * kHalfSmoothing + 1;
  const double span_s = static_cast<double>(reach) * session.rig.period_s();
  Eigen::VectorXd row(columns);
  for (std::size_t k = reach; k + reach < r.size(); k += kRowEvery) {
    if (std::abs(at[k].v_m_per_s) < least_speed_m_per_s(session)) continue;
    const double acceleration = (y[k + reach] - 2 * y[k] + y[k - reach]) / (span_s * span_s);
    library.evaluate(at[k], row.data());
    sums.add_row(row, acceleration);
  }
  return sums;
}

NormalEquations in_weak_form(const Session& session, const Recording& r, const Library& library) {
  const auto columns = static_cast<Eigen::Index>(library.size());
  NormalEquations sums(columns);
  const std::vector<Instant> at = instants(r, session.rig, smoothed(r.y_m), r.u_V);
  Eigen::MatrixXd values(columns, static_cast<Eigen::Index>(r.size()));
  for (std::size_t k = 0; k < r.size(); ++k)
    library.evaluate(at[k], values.col(static_cast<Eigen::Index>(k)).data());
  const double half_s = static_cast<double>(kHalfWindow) * session.rig.period_s();
  Eigen::VectorXd row(columns);
  for (std::size_t centre = kHalfWindow; centre + kHalfWindow + 1 < r.size(); centre += kWindowEvery) {
    row.setZero();
    double right = 0;
    bool rests = false;
    for (std::size_t k = centre - kHalfWindow; k <= centre + kHalfWindow && !rests; ++k) {
      rests = std::abs(at[k].v_m_per_s) < least_speed_m_per_s(session);
      const double hold_s = r.t_s[k + 1] - r.t_s[k];
      // The voltage acts from this reading to the next; positions count about their middle.
      const double s = (0.5 * (r.t_s[k] + r.t_s[k + 1]) - r.t_s[centre]) / half_s;
      if (std::abs(s) >= 1) continue;
      const double w = 1 - s * s;
      const double bump = w * w * w * w;
      const double second = (48 * s * s * w * w - 8 * w * w * w) / (half_s * half_s);
      const double away = 0.5 * (r.y_m[k] + r.y_m[k + 1]) - r.y_m[centre];
      right += second * away * hold_s;
      row += bump * hold_s * values.col(static_cast<Eigen::Index>(k));
    }
    // In units of acceleration: the bump's own area is 256/315 of its width.
    if (!rests) sums.add_row(row / half_s, right / half_s);
  }
  return sums;
}

/// Terms whose columns stayed beyond the nominal ones; first the one whose loss leaves most unexplained.
std::vector<std::string> names_of(const NormalEquations& all, const Library& library,
                                  const Eigen::VectorXd& coefficients) {
  std::map<std::string, double> loss;
  for (std::size_t c = library.nominal_columns(); c < library.size(); ++c) {
    if (coefficients[static_cast<Eigen::Index>(c)] != 0) loss[library.name(c)] = 0;
  }
  for (auto& [name, left] : loss) {
    Eigen::VectorXd without = coefficients;
    for (std::size_t c = library.nominal_columns(); c < library.size(); ++c) {
      if (library.name(c) == name) without[static_cast<Eigen::Index>(c)] = 0;
    }
    left = all.left(without);
  }
  std::vector<std::string> names;
  for (const auto& [name, left] : loss) names.push_back(name);
  std::stable_sort(names.begin(), names.end(),
                   [&](const std::string& a, const std::string& b) { return loss[a] > loss[b]; });
  return names;
}

template <typename Rows>
std::vector<std::string> sparse(const Session& session, const Model& nominal, const Rows& rows) {
  const Library library(session, nominal);
  std::vector<NormalEquations> parts;
  NormalEquations all(static_cast<Eigen::Index>(library.size()));
  for (const Recording& r : session.recordings) {
    parts.push_back(rows(session, r, library));
    parts.back().mirror();
    all += parts.back();
  }
  const auto kept = static_cast<Eigen::Index>(library.nominal_columns());
  return names_of(all, library, stlsq_cross_validated(parts, kept));
}

}  // namespace

std::vector<std::string> sparse_by_derivatives(const Session& session, const Model& nominal) {
  return sparse(session, nominal, by_derivatives);
}

std::vector<std::string> sparse_in_weak_form(const Session& session, const Model& nominal) {
  return sparse(session, nominal, in_weak_form);
}

}  // namespace cartwright::blind
