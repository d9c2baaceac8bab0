#include "host/identify/identify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/identify/intervals.hpp"
#include "host/identify/problem.hpp"
#include "host/identify/shape_search.hpp"

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct FirstFit {
  std::vector<MatrixXd> columns;
  Linear linear;
  Model model;
};

/// Least squares, the shapes searched for around it.
FirstFit first_fit(const Problem& problem, const TermSet& terms,
                   const std::function<void(double)>& progress) {
  Model shape;
  if (!terms.shapes().empty()) {
    shape = search_shapes(
        terms.shapes(), problem.range(),
        [&](const Model& candidate) { return problem.least_squares(problem.all_columns(candidate)).cost; },
        progress);
  }
  FirstFit out;
  out.columns = problem.all_columns(shape);
  out.linear = problem.least_squares(out.columns);
  out.model = terms.to_model(out.linear.theta, shape);
  return out;
}

}  // namespace

Result<Identification> identify(const Session& session, const TermSet& terms,
                                const IdentifyOptions& options) {
  Problem problem(session, terms, options);
  const std::size_t unknowns = terms.features().size() + terms.shapes().size();
  if (problem.windows() < 2 * unknowns) {
    return failure(
        fmt::format("the cart moves too little: {} windows of {:.0f} ms without standstill, {} numbers to "
                    "find need at least {}",
                    problem.windows(), 1e3 * options.weak.window_s, unknowns, 2 * unknowns));
  }
  FirstFit fit = first_fit(problem, terms, options.progress);
  // Smoothing blurs the moment of a reversal, where friction jumps; the model's own velocity does not.
  if (terms.has(Term::coulomb_friction) && fit.linear.null_directions.cols() == 0) {
    Problem sharper = problem;
    sharper.take_velocities(fit.model);
    FirstFit second = first_fit(sharper, terms, options.progress);
    if (second.linear.cost < fit.linear.cost) {
      problem = std::move(sharper);
      fit = std::move(second);
    }
  }
  const Linear& linear = fit.linear;
  const Model& shape = fit.model;
  Solution solution;
  solution.jacobian = std::move(fit.columns);
  solution.theta = linear.theta;
  solution.model = fit.model;

  Identification out;
  solution.instruments = solution.jacobian;
  const bool at_bound =
      std::find(linear.at_bound.begin(), linear.at_bound.end(), true) != linear.at_bound.end();
  if (options.instruments && !at_bound && linear.null_directions.cols() == 0) {
    solution.instruments = problem.instruments(solution.model, solution.jacobian, out.twins);
    if (out.twins > 0) {
      const Index size = solution.theta.size();
      MatrixXd ZX = MatrixXd::Zero(size, size);
      VectorXd Zb = VectorXd::Zero(size);
      for (std::size_t i = 0; i < solution.jacobian.size(); ++i) {
        ZX.noalias() += solution.instruments[i].transpose() * solution.jacobian[i];
        Zb.noalias() += solution.instruments[i].transpose() * problem.prepared()[i].response;
      }
      const VectorXd theta = ZX.colPivHouseholderQr().solve(Zb);
      bool allowed = theta.allFinite();
      for (Index i = 0; i < size; ++i) {
        if (terms.nonnegative(terms.features()[static_cast<std::size_t>(i)]) && theta[i] < 0) allowed = false;
      }
      if (allowed) {
        solution.theta = theta;
        solution.model = terms.to_model(theta, shape);
      } else {
        solution.instruments = solution.jacobian;
        out.twins = 0;
      }
    }
  }
  double left = 0, whole = 0;
  for (std::size_t i = 0; i < solution.jacobian.size(); ++i) {
    const VectorXd& response = problem.prepared()[i].response;
    solution.residual.push_back(response - solution.jacobian[i] * solution.theta);
    left += solution.residual.back().squaredNorm();
    whole += response.squaredNorm();
  }
  out.model = solution.model;
  out.windows = problem.windows();
  out.residual_m_per_s2 = std::sqrt(left / static_cast<double>(out.windows));
  out.acceleration_m_per_s2 = std::sqrt(whole / static_cast<double>(out.windows));
  add_estimates(problem, terms, linear, std::move(solution), options, out);
  return out;
}

}  // namespace cartwright
