#include "host/identify/quadratic_program.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRidge = 1e-12;

/// Unconstrained minimum over the chosen entries of  1/2 l' Q l - b' l, the others zero.
VectorXd minimum_over(const MatrixXd& Q, const VectorXd& b, const std::vector<Index>& chosen) {
  const auto size = static_cast<Index>(chosen.size());
  MatrixXd part(size, size);
  VectorXd right(size);
  for (Index i = 0; i < size; ++i) {
    right[i] = b[chosen[static_cast<std::size_t>(i)]];
    for (Index j = 0; j < size; ++j) {
      part(i, j) = Q(chosen[static_cast<std::size_t>(i)], chosen[static_cast<std::size_t>(j)]);
    }
  }
  // More active constraints than unknowns make the part singular; the ridge then sends some multiplier far
  // below zero, and its constraint is let go again.
  part.diagonal().array() += kRidge * Q.diagonal().maxCoeff();
  const VectorXd solved = part.ldlt().solve(right);
  VectorXd out = VectorXd::Zero(Q.rows());
  for (Index i = 0; i < size; ++i) out[chosen[static_cast<std::size_t>(i)]] = solved[i];
  return out;
}

/// Lawson and Hanson: minimises 1/2 l' Q l - b' l over l >= 0.
VectorXd nonnegative_minimum(const MatrixXd& Q, const VectorXd& b, bool& converged) {
  const Index size = Q.rows();
  VectorXd l = VectorXd::Zero(size);
  std::vector<bool> passive(static_cast<std::size_t>(size), false);
  const double tolerance = 1e-12 * (b.cwiseAbs().maxCoeff() + Q.cwiseAbs().maxCoeff() * 1e-3);
  converged = false;
  for (Index round = 0; round < 5 * size + 20; ++round) {
    const VectorXd gain = b - Q * l;
    Index best = -1;
    for (Index i = 0; i < size; ++i) {
      if (!passive[static_cast<std::size_t>(i)] && gain[i] > tolerance && (best < 0 || gain[i] > gain[best]))
        best = i;
    }
    if (best < 0) {
      converged = true;
      return l;
    }
    passive[static_cast<std::size_t>(best)] = true;
    while (true) {
      std::vector<Index> chosen;
      for (Index i = 0; i < size; ++i) {
        if (passive[static_cast<std::size_t>(i)]) chosen.push_back(i);
      }
      const VectorXd wanted = minimum_over(Q, b, chosen);
      double reach = 1;
      for (const Index i : chosen) {
        if (wanted[i] <= 0) reach = std::min(reach, l[i] / std::max(l[i] - wanted[i], 1e-300));
      }
      l += reach * (wanted - l);
      if (reach >= 1) break;
      for (const Index i : chosen) {
        if (l[i] <= 1e-14 * l.cwiseAbs().maxCoeff()) {
          l[i] = 0;
          passive[static_cast<std::size_t>(i)] = false;
        }
      }
      if (!passive[static_cast<std::size_t>(best)] && chosen.size() == 1) break;
    }
  }
  return l;
}

}  // namespace

double KktResidual::greatest() const {
  return std::max({stationarity, primal, dual, complementarity});
}

KktResidual kkt_residual(const MatrixXd& H, const VectorXd& g, const MatrixXd& G, const VectorXd& h,
                         const VectorXd& x, const VectorXd& multipliers) {
  KktResidual out;
  VectorXd pull = H * x;
  const double force = std::max({pull.cwiseAbs().maxCoeff(), g.cwiseAbs().maxCoeff(), 1e-300});
  pull -= g;
  if (G.rows() > 0) {
    pull -= G.transpose() * multipliers;
    const VectorXd slack = G * x - h;
    const double size = std::max({(G * x).cwiseAbs().maxCoeff(), h.cwiseAbs().maxCoeff(), 1e-300});
    out.primal = std::max(0.0, -slack.minCoeff()) / size;
    out.dual = std::max(0.0, -multipliers.minCoeff()) / force;
    out.complementarity = multipliers.cwiseProduct(slack).cwiseAbs().maxCoeff() / (force * size);
  }
  out.stationarity = pull.cwiseAbs().maxCoeff() / force;
  return out;
}

QuadraticSolution minimise(const MatrixXd& H, const VectorXd& g, const MatrixXd& G, const VectorXd& h) {
  QuadraticSolution out;
  const Eigen::LLT<MatrixXd> factor(H);
  out.x = factor.solve(g);
  out.multipliers = VectorXd::Zero(G.rows());
  out.converged = true;
  if (G.rows() > 0 && (G * out.x - h).minCoeff() < 0) {
    const MatrixXd inverse_G = factor.solve(G.transpose());
    out.multipliers = nonnegative_minimum(G * inverse_G, h - G * out.x, out.converged);
    out.x += inverse_G * out.multipliers;
  }
  out.kkt = kkt_residual(H, g, G, h, out.x, out.multipliers);
  return out;
}

}  // namespace cartwright
