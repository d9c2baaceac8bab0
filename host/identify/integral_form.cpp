#include "host/identify/integral_form.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/identify/bounded_quadratic.hpp"

namespace cartwright {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The integrals that run along an interval: I = int y, S = int s, J = int int s.
struct Running {
  double I = 0, S = 0, J = 0;

  /// Exact for y straight between samples and s held (or s = y).
  void step(double h, double y0, double y1, const double* held) {
    const double before_I = I;
    I += 0.5 * h * (y0 + y1);
    if (held != nullptr) {
      J += h * (S + 0.5 * h * *held);
      S += h * *held;
    } else {
      J += h * (before_I + h * (2 * y0 + y1) / 6);
      S = I;
    }
  }
};

/// Normal equations of y = a + b tau - c I - k J, entry by entry so that the compiler keeps them in
/// registers.
struct LocalSums {
  double n = 0, t = 0, i = 0, j = 0, tt = 0, ti = 0, tj = 0, ii = 0, ij = 0, jj = 0;
  double y = 0, ty = 0, iy = 0, jy = 0;

  void add(double tau, const Running& r, double value) {
    n += 1;
    t += tau;
    i += r.I;
    j += r.J;
    tt += tau * tau;
    ti += tau * r.I;
    tj += tau * r.J;
    ii += r.I * r.I;
    ij += r.I * r.J;
    jj += r.J * r.J;
    y += value;
    ty += tau * value;
    iy += r.I * value;
    jy += r.J * value;
  }

  Eigen::Matrix4d gram() const {
    Eigen::Matrix4d out;
    out << n, t, -i, -j, t, tt, -ti, -tj, -i, -ti, ii, ij, -j, -tj, ij, jj;
    return out;
  }
  Eigen::Vector4d right() const { return {y, ty, -iy, -jy}; }
};

/// Solves H x = g after scaling H to a unit diagonal.
template <typename Matrix, typename Vector>
Vector solve_scaled(const Matrix& H, const Vector& g) {
  const Vector scale = H.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * H * scale.asDiagonal();
  return scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(g)));
}

}  // namespace

ConstantFit fit_constant(const IntegralData& data) {
  LocalSums sums;
  Running running;
  const double start_s = data.t_s.front();
  sums.add(0, running, data.y_m[0]);
  for (std::size_t row = 1; row < data.t_s.size(); ++row) {
    running.step(data.t_s[row] - data.t_s[row - 1], data.y_m[row - 1], data.y_m[row],
                 data.held.empty() ? nullptr : &data.held[row - 1]);
    sums.add(data.t_s[row] - start_s, running, data.y_m[row]);
  }
  const Eigen::Vector4d x = solve_scaled<Eigen::Matrix4d, Eigen::Vector4d>(sums.gram(), sums.right());
  return {x[0], x[1], x[2], x[3]};
}

PiecewiseForm::PiecewiseForm(const IntegralData& data, std::size_t intervals) : data_(data) {
  const std::size_t rows = data.t_s.size();
  const double start_s = data.t_s.front();
  const double length_s = (data.t_s.back() - start_s) / static_cast<double>(intervals);
  boundaries_.push_back(0);
  for (std::size_t i = 1; i < intervals; ++i) {
    const double end_s =
        start_s + length_s * static_cast<double>(i) - 0.5 * length_s / static_cast<double>(rows);
    boundaries_.push_back(static_cast<std::size_t>(std::lower_bound(data.t_s.begin(), data.t_s.end(), end_s) -
                                                   data.t_s.begin()));
  }
  boundaries_.push_back(rows);

  const auto size = static_cast<Index>(intervals) + 3;
  const Index k = size - 1;
  H_ = MatrixXd::Zero(size, size);
  g_ = VectorXd::Zero(size);
  MatrixXd W = MatrixXd::Zero(4, size);  // rows: y, alpha, c, k of this interval
  W(0, 0) = W(1, 1) = W(3, k) = 1;
  for (std::size_t i = 0; i < intervals; ++i) {
    const auto c = static_cast<Index>(i) + 2;
    W.row(2).setZero();
    W(2, c) = 1;
    local_.push_back(W);
    LocalSums sums;
    Running running;
    const std::size_t first = boundaries_[i], last = boundaries_[i + 1];
    const double from_s = data.t_s[first];
    sums.add(0, running, data.y_m[first]);
    for (std::size_t row = first + 1; row < std::min(last + 1, rows); ++row) {
      running.step(data.t_s[row] - data.t_s[row - 1], data.y_m[row - 1], data.y_m[row],
                   data.held.empty() ? nullptr : &data.held[row - 1]);
      if (row < last) sums.add(data.t_s[row] - from_s, running, data.y_m[row]);
    }
    H_.noalias() += W.transpose() * (sums.gram() * W);
    g_.noalias() += W.transpose() * sums.right();
    if (last >= rows) break;
    // Continuity, Eq. (12): y_i, and alpha_i = alpha_(i-1) + (c_(i+1) - c_i) y_m(T_i) - k S_i.
    W.row(0) += (data.t_s[last] - from_s) * W.row(1);
    W(0, c) -= running.I;
    W(0, k) -= running.J;
    W(1, c) -= data.y_m[last];
    W(1, c + 1) += data.y_m[last];
    W(1, k) -= running.S;
  }
}

namespace {

/// Bounds on c(i+1) - c(i).
struct StepBounds {
  double lower = -std::numeric_limits<double>::infinity(), upper = -lower;

  StepBounds(const DampingConstraints& constraints, double length_s) {
    if (constraints.least_rise_per_s) lower = *constraints.least_rise_per_s;
    if (constraints.greatest_rise_per_s) upper = *constraints.greatest_rise_per_s;
    if (constraints.greatest_slope_per_s2) {
      lower = std::max(lower, -*constraints.greatest_slope_per_s2 * length_s);
      upper = std::min(upper, *constraints.greatest_slope_per_s2 * length_s);
    }
  }
  bool any() const { return std::isfinite(lower) || std::isfinite(upper); }
};

/// y0, alpha0, c_1 ... c_n, k from y0, alpha0, c_1, the steps c(i+1) - c(i), k.
MatrixXd from_steps(Index size) {
  MatrixXd T = MatrixXd::Identity(size, size);
  for (Index i = 3; i + 1 < size; ++i) {
    for (Index j = 2; j < i; ++j) T(i, j) = 1;
  }
  return T;
}

/// The same bounds as G x >= h, lower ones first.
void as_inequalities(const StepBounds& bounds, Index size, MatrixXd& G, VectorXd& h) {
  const Index steps = size - 4, low = std::isfinite(bounds.lower) ? steps : 0;
  const Index high = std::isfinite(bounds.upper) ? steps : 0;
  G = MatrixXd::Zero(low + high, size);
  h.resize(low + high);
  h << VectorXd::Constant(low, bounds.lower), VectorXd::Constant(high, -bounds.upper);
  for (Index i = 0; i < steps; ++i) {
    if (low > 0) G(i, i + 3) = 1, G(i, i + 2) = -1;
    if (high > 0) G(low + i, i + 3) = -1, G(low + i, i + 2) = 1;
  }
}

}  // namespace

PiecewiseForm::Factored PiecewiseForm::factored() const {
  const auto size = g_.size();
  const auto count = static_cast<Index>(intervals());
  // Each interval's samples shrink to four rows, in its own four unknowns; these to rows of all unknowns.
  MatrixXd rows(4 * count, size + 1);
  MatrixXd samples(0, 5);
  std::size_t current = 0;
  const auto reduce = [&](std::size_t interval) {
    const auto first = static_cast<Index>(4 * interval);
    const Eigen::HouseholderQR<MatrixXd> qr(samples.leftCols(4));
    const VectorXd right = qr.householderQ().transpose() * samples.col(4);
    MatrixXd R = MatrixXd::Zero(4, 4);
    const Index kept = std::min<Index>(4, samples.rows());
    R.topRows(kept) = qr.matrixQR().topRows(kept).triangularView<Eigen::Upper>();
    rows.block(first, 0, 4, size).noalias() = R * local_[interval];
    rows.block(first, size, 4, 1).setZero();
    rows.block(first, size, kept, 1) = right.head(kept);
  };
  const auto rows_of = [&](std::size_t interval) {
    return static_cast<Index>(boundaries_[interval + 1] - boundaries_[interval]);
  };
  samples.resize(rows_of(0), 5);
  each_sample([&](std::size_t row, std::size_t interval, const Eigen::RowVector4d& basis) {
    if (interval != current) {
      reduce(current);
      current = interval;
      samples.resize(rows_of(interval), 5);
    }
    samples.row(static_cast<Index>(row - boundaries_[interval])) << basis, data_.y_m[row];
  });
  reduce(current);
  const Eigen::HouseholderQR<MatrixXd> qr(rows.leftCols(size));
  const Index kept = std::min(size, rows.rows());
  Factored out{MatrixXd::Zero(kept, size), (qr.householderQ().transpose() * rows.col(size)).head(kept)};
  out.R = qr.matrixQR().topRows(kept).triangularView<Eigen::Upper>();
  return out;
}

QuadraticSolution PiecewiseForm::solve(const DampingConstraints& constraints, const VectorXd& shift) const {
  const double length_s = (data_.t_s.back() - data_.t_s.front()) / static_cast<double>(intervals());
  const StepBounds bounds(constraints, length_s);
  const Index size = g_.size(), steps = size - 4;
  // Scaled unknowns; the residuals of the optimum are reported for the scaled programme.
  const VectorXd scale = H_.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd H = scale.asDiagonal() * H_ * scale.asDiagonal();
  const VectorXd g = scale.cwiseProduct(g_ + shift);
  QuadraticSolution out = minimise(H, g, MatrixXd(0, size), VectorXd(0));
  if (bounds.any() && steps > 0) {
    const MatrixXd T = from_steps(size);
    const Factored whole = factored();
    MatrixXd A = whole.R * T;
    const VectorXd unit = A.colwise().norm().cwiseInverse();
    A = A * unit.asDiagonal();
    const double none = std::numeric_limits<double>::infinity();
    VectorXd lower = VectorXd::Constant(size, -none), upper = VectorXd::Constant(size, none);
    lower.segment(3, steps).setConstant(bounds.lower);
    upper.segment(3, steps).setConstant(bounds.upper);
    const BoundedSolution found = minimise_within(A, whole.right, unit.cwiseProduct(T.transpose() * shift),
                                                  lower.cwiseQuotient(unit), upper.cwiseQuotient(unit));
    out.x = (T * unit.cwiseProduct(found.x)).cwiseQuotient(scale);
    out.converged = found.converged && bounds.lower <= bounds.upper;
    MatrixXd G;
    VectorXd h;
    as_inequalities(bounds, size, G, h);
    const VectorXd pull = found.multipliers.cwiseQuotient(unit).segment(3, steps);
    out.multipliers.resize(h.size());
    if (std::isfinite(bounds.lower)) out.multipliers.head(steps) = pull.cwiseMax(0);
    if (std::isfinite(bounds.upper)) out.multipliers.tail(steps) = (-pull).cwiseMax(0);
    out.kkt = kkt_residual(H, g, G * scale.asDiagonal(), h, out.x, out.multipliers);
  }
  out.x = scale.cwiseProduct(out.x);
  return out;
}

PiecewiseFit PiecewiseForm::fit(const DampingConstraints& constraints) const {
  PiecewiseFit out;
  out.solution = solve(constraints, VectorXd::Zero(g_.size()));
  out.unknowns = out.solution.x;
  out.start_m = out.unknowns[0];
  out.alpha_m_per_s = out.unknowns[1];
  out.stiffness = out.unknowns[out.unknowns.size() - 1];
  for (Index i = 2; i + 1 < out.unknowns.size(); ++i) out.damping_per_s.push_back(out.unknowns[i]);
  out.boundaries = boundaries_;
  return out;
}

/// Calls visit(row, interval, (1, tau, -I, -J)) for every sample.
template <typename Visit>
void PiecewiseForm::each_sample(Visit&& visit) const {
  for (std::size_t i = 0; i < intervals(); ++i) {
    Running running;
    for (std::size_t row = boundaries_[i]; row < boundaries_[i + 1]; ++row) {
      if (row > boundaries_[i]) {
        running.step(data_.t_s[row] - data_.t_s[row - 1], data_.y_m[row - 1], data_.y_m[row],
                     data_.held.empty() ? nullptr : &data_.held[row - 1]);
      }
      visit(row, i,
            Eigen::RowVector4d(1, data_.t_s[row] - data_.t_s[boundaries_[i]], -running.I, -running.J));
    }
  }
}

std::vector<double> PiecewiseForm::predict(const VectorXd& unknowns) const {
  std::vector<double> out(data_.t_s.size());
  std::vector<Eigen::Vector4d> local;
  for (const MatrixXd& W : local_) local.push_back(W * unknowns);
  each_sample([&](std::size_t row, std::size_t interval, const Eigen::RowVector4d& basis) {
    out[row] = basis * local[interval];
  });
  return out;
}

std::vector<VectorXd> PiecewiseForm::block_gradients(const VectorXd& unknowns, double block_s) const {
  std::vector<VectorXd> out;
  const std::vector<double> fitted_m = predict(unknowns);
  double start_s = -1e300;
  each_sample([&](std::size_t row, std::size_t interval, const Eigen::RowVector4d& basis) {
    if (data_.t_s[row] - start_s >= block_s) {
      start_s = data_.t_s[row];
      out.push_back(VectorXd::Zero(g_.size()));
    }
    out.back() += (data_.y_m[row] - fitted_m[row]) * (local_[interval].transpose() * basis.transpose());
  });
  return out;
}

}  // namespace cartwright
