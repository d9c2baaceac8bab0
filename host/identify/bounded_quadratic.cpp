#include "host/identify/bounded_quadratic.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

enum class Place { free, at_lower, at_upper };

struct Quadratic {
  const MatrixXd& A;
  const VectorXd &b, &s;

  VectorXd gradient(const VectorXd& x) const { return A.transpose() * (A * x - b) - s; }
};

/// The entries that are free and the minimum over them, the others staying where they are.
struct FreePart {
  std::vector<Index> entries;
  VectorXd wanted;

  FreePart(const Quadratic& problem, const VectorXd& x, const std::vector<Place>& place) {
    for (Index i = 0; i < x.size(); ++i) {
      if (place[static_cast<std::size_t>(i)] == Place::free) entries.push_back(i);
    }
    wanted = x(entries);
    if (entries.empty()) return;
    // A_free = Q R P': the step d solves R'R P'd = R'Q'(b - A x) + P's. Columns that add nothing stay put.
    const Eigen::ColPivHouseholderQR<MatrixXd> qr(problem.A(Eigen::all, entries));
    const Index rank = qr.rank();
    const auto R = qr.matrixQR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>();
    VectorXd right = (qr.householderQ().transpose() * (problem.b - problem.A * x)).head(rank);
    const VectorXd s_free = qr.colsPermutation().transpose() * VectorXd(problem.s(entries));
    if (!s_free.isZero(0)) right += R.transpose().solve(s_free.head(rank));
    VectorXd step = VectorXd::Zero(wanted.size());
    step.head(rank) = R.solve(right);
    wanted += VectorXd(qr.colsPermutation() * step);
  }
};

}  // namespace

BoundedSolution minimise_within(const MatrixXd& A, const VectorXd& b, const VectorXd& s,
                                const VectorXd& lower, const VectorXd& upper) {
  const Quadratic problem{A, b, s};
  const Index size = A.cols();
  std::vector<Place> place(static_cast<std::size_t>(size), Place::free);
  const auto at = [&place](Index i) -> Place& { return place[static_cast<std::size_t>(i)]; };
  BoundedSolution out;
  out.x = VectorXd::Zero(size);
  for (Index i = 0; i < size; ++i) {
    if (std::isfinite(lower[i])) {
      at(i) = Place::at_lower;
      out.x[i] = lower[i];
    } else if (std::isfinite(upper[i])) {
      at(i) = Place::at_upper;
      out.x[i] = upper[i];
    }
  }
  // Next to nothing: hundreds of damping values hang on pulls far below rounding of the whole. What is freed
  // by rounding alone comes back to its bound and is refused.
  const double tolerance =
      1e-18 * std::max(problem.gradient(VectorXd::Zero(size)).cwiseAbs().maxCoeff(), 1e-300);
  std::vector<bool> refused(place.size(), false);  // would leave its bound to the wrong side: rounding
  for (Index round = 0; round < 20 * size + 20; ++round) {
    // The minimum over the free entries, entries that would cross a bound stopping there.
    Index just_freed = -1;
    if (round > 0) {
      const VectorXd gradient = problem.gradient(out.x);
      double steepest = tolerance;
      for (Index i = 0; i < size; ++i) {
        const double pull = at(i) == Place::at_lower   ? -gradient[i]
                            : at(i) == Place::at_upper ? gradient[i]
                                                       : 0;
        if (pull > steepest && !refused[static_cast<std::size_t>(i)]) {
          steepest = pull;
          just_freed = i;
        }
      }
      if (just_freed < 0) {
        out.converged = true;
        break;
      }
      at(just_freed) = Place::free;
    }
    bool moved = false;
    while (true) {
      const FreePart part(problem, out.x, place);
      double reach = 1;
      Index stops = -1;
      for (std::size_t n = 0; n < part.entries.size(); ++n) {
        const Index i = part.entries[n];
        const double to = part.wanted[static_cast<Index>(n)], from = out.x[i];
        const double limit = to < lower[i] ? lower[i] : (to > upper[i] ? upper[i] : to);
        if (limit == to) continue;
        const double share = (limit - from) / (to - from);
        if (share < reach) {
          reach = share;
          stops = i;
        }
      }
      for (std::size_t n = 0; n < part.entries.size(); ++n) {
        const Index i = part.entries[n];
        out.x[i] += reach * (part.wanted[static_cast<Index>(n)] - out.x[i]);
      }
      moved = moved || reach > 0;
      if (stops < 0) break;
      const bool low =
          part.wanted[std::find(part.entries.begin(), part.entries.end(), stops) - part.entries.begin()] <
          lower[stops];
      at(stops) = low ? Place::at_lower : Place::at_upper;
      out.x[stops] = low ? lower[stops] : upper[stops];
      if (stops == just_freed && !moved) break;
    }
    if (moved) {
      refused.assign(refused.size(), false);
    } else if (just_freed >= 0) {
      refused[static_cast<std::size_t>(just_freed)] = true;
    }
  }
  out.multipliers = VectorXd::Zero(size);
  const VectorXd gradient = problem.gradient(out.x);
  for (Index i = 0; i < size; ++i) {
    if (at(i) != Place::free) out.multipliers[i] = gradient[i];
  }
  return out;
}

}  // namespace cartwright
