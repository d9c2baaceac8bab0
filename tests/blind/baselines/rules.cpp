#include "tests/blind/baselines/rules.hpp"

#include <cmath>

#include "host/diagnose/judge/held_out.hpp"
#include "host/diagnose/judge/prediction_errors.hpp"

namespace cartwright::blind {
namespace {

std::string name_of(Term term) {
  return std::string(info(term).name);
}

/// Free numbers; each lost burst has a size and a time.
double numbers(const OneMore& one) {
  return static_cast<double>(one.fit.free.size() + 2 * one.jumps.size());
}

/// The term that lowers the criterion most, if any does.
const OneMore* least_bic(const OneRound& round) {
  const double price = std::log(static_cast<double>(round.base.rows));
  double least = -2 * round.base.log_likelihood + price * static_cast<double>(round.base.free.size());
  const OneMore* best = nullptr;
  for (const OneMore& one : round.tried) {
    const double bic = -2 * one.fit.log_likelihood + price * numbers(one);
    if (bic < least) least = bic, best = &one;
  }
  return best;
}

std::size_t rows_of(const Session& session) {
  std::size_t rows = 0;
  for (const Recording& r : session.recordings) rows += r.size();
  return rows;
}

}  // namespace

Names most_gain(const OneRound& first) {
  if (first.tried.empty() || first.tried.front().fit.log_likelihood <= first.base.log_likelihood) return {};
  return {name_of(first.tried.front().term)};
}

Names stepwise_bic(const Session& session, const OneRound& first) {
  const OneMore* one = least_bic(first);
  if (!one) return {};
  const OneRound second = one_round(without_jumps(session, one->jumps), one->fit);
  const OneMore* more = least_bic(second);
  return more ? Names{name_of(one->term), name_of(more->term)} : Names{name_of(one->term)};
}

Names bic_of_windows(const Session& session, const OneRound& first) {
  const double rows = static_cast<double>(rows_of(session));
  const auto bic = [&](const Model& model, const Session& data, double k) {
    return 2 * rows * std::log(window_rmse_m(model, data, 1)) + k * std::log(rows);
  };
  double least = bic(first.base.model, session, static_cast<double>(first.base.free.size()));
  Names named;
  for (const OneMore& one : first.tried) {
    const double value = bic(one.fit.model, without_jumps(session, one.jumps), numbers(one));
    if (value < least) least = value, named = {name_of(one.term)};
  }
  return named;
}

Names single_split(const Session& session, const Model& nominal) {
  std::vector<std::size_t> odd;
  for (std::size_t n = 1; n < session.recordings.size(); n += 2) odd.push_back(n);
  const Session fitted = without(session, odd), judged = only(session, odd);
  const OneRound round = one_round(fitted, nominal);
  double least = window_rmse_m(round.base.model, judged, 1);
  Names named;
  for (const OneMore& one : round.tried) {
    const double error = window_rmse_m(one.fit.model, judged, 1);
    if (error < least) least = error, named = {name_of(one.term)};
  }
  return named;
}

}  // namespace cartwright::blind
