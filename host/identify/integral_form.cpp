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

/// Solves H x = g after scaling H to a unit diagonal.
template <typename Matrix, typename Vector>
Vector solve_scaled(const Matrix& H, const Vector& g) {
  const Vector scale = H.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * H * scale.asDiagonal();
  return scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(g)));
}

}  // namespace

ConstantFit fit_constant(const IntegralData& data) {
  const IntervalSums sums = interval_sums(data, 0, data.t_s.size());
  const Eigen::Vector4d x = solve_scaled<Eigen::Matrix4d, Eigen::Vector4d>(sums.gram, sums.right);
  return {x[0], x[1], x[2], x[3]};
}

namespace {

/// y and alpha at the start of an interval as linear forms of the unknowns y0, alpha0, c_1 ... c_n, k.
struct StartForms {
  VectorXd y, alpha;

  explicit StartForms(Index size) : y(VectorXd::Unit(size, 0)), alpha(VectorXd::Unit(size, 1)) {}

  /// On to the next interval. Continuity, Eq. (12): y_i, and alpha_i = alpha_(i-1) + (c_(i+1) - c_i) y_m(T_i)
  /// - k S_i. `c` is where c_i stands.
  void advance(Index c, double length_s, double measured_m, const RunningIntegrals& end) {
    const Index k = y.size() - 1;
    y += length_s * alpha;
    y[c] -= end.I;
    y[k] -= end.J;
    alpha[c] -= measured_m;
    alpha[c + 1] += measured_m;
    alpha[k] -= end.S;
  }
};

/// Adds W' G W and W' r, where W has the rows y, alpha, c and k of an interval; the upper triangle alone.
void add_interval(const StartForms& start, Index c, const IntervalSums& sums, MatrixXd& H, VectorXd& g) {
  const Index k = g.size() - 1;
  const double* y = start.y.data();
  const double* alpha = start.alpha.data();
  const auto add_column = [&](Index j) {
    Eigen::Vector4d GW = y[j] * sums.gram.col(0) + alpha[j] * sums.gram.col(1);
    if (j == c) GW += sums.gram.col(2);
    if (j == k) GW += sums.gram.col(3);
    double* column = H.data() + j * H.rows();
    const Index rows = std::min(j, c) + 1;  // of the damping values after c the interval knows nothing
    for (Index i = 0; i < rows; ++i) column[i] += GW[0] * y[i] + GW[1] * alpha[i];
    if (j >= c) column[c] += GW[2];
    if (j == k) column[k] += GW[0] * y[k] + GW[1] * alpha[k] + GW[3];
  };
  for (Index j = 0; j <= c; ++j) add_column(j);
  add_column(k);
  g += sums.right[0] * start.y + sums.right[1] * start.alpha;
  g[c] += sums.right[2];
  g[k] += sums.right[3];
}

/// The row at which the time reaches `at_s`. Looked for from where it is when rows are even.
std::size_t row_at(std::span<const double> t_s, double at_s) {
  const double share = (at_s - t_s.front()) / (t_s.back() - t_s.front());
  auto row = static_cast<std::size_t>(share * static_cast<double>(t_s.size() - 1));
  while (row > 0 && t_s[row - 1] >= at_s) --row;
  while (row < t_s.size() && t_s[row] < at_s) ++row;
  return row;
}

}  // namespace

PiecewiseForm::PiecewiseForm(const IntegralData& data, std::size_t intervals) : data_(data) {
  const std::size_t rows = data.t_s.size();
  const double start_s = data.t_s.front();
  const double length_s = (data.t_s.back() - start_s) / static_cast<double>(intervals);
  boundaries_.reserve(intervals + 1);
  at_end_.reserve(intervals);
  boundaries_.push_back(0);
  for (std::size_t i = 1; i < intervals; ++i) {
    const double end_s =
        start_s + length_s * static_cast<double>(i) - 0.5 * length_s / static_cast<double>(rows);
    boundaries_.push_back(row_at(data.t_s, end_s));
  }
  boundaries_.push_back(rows);

  const auto size = static_cast<Index>(intervals) + 3;
  H_ = MatrixXd::Zero(size, size);
  g_ = VectorXd::Zero(size);
  StartForms start(size);
  for (std::size_t i = 0; i < intervals; ++i) {
    const auto c = static_cast<Index>(i) + 2;
    const std::size_t first = boundaries_[i], last = boundaries_[i + 1];
    const IntervalSums sums = interval_sums(data, first, last);
    add_interval(start, c, sums, H_, g_);
    at_end_.push_back(sums.at_end);
    if (last < rows) start.advance(c, data.t_s[last] - data.t_s[first], data.y_m[last], sums.at_end);
  }
  H_.triangularView<Eigen::StrictlyLower>() = H_.transpose();
}

template <typename Visit>
void PiecewiseForm::each_interval(Visit&& visit) const {
  StartForms start(g_.size());
  MatrixXd W = MatrixXd::Zero(4, g_.size());
  W(3, g_.size() - 1) = 1;
  for (std::size_t i = 0; i < intervals(); ++i) {
    const auto c = static_cast<Index>(i) + 2;
    W.row(0) = start.y;
    W.row(1) = start.alpha;
    W(2, c - 1) = 0;
    W(2, c) = 1;
    visit(i, W);
    if (i + 1 == intervals()) break;
    const std::size_t next = boundaries_[i + 1];
    start.advance(c, data_.t_s[next] - data_.t_s[boundaries_[i]], data_.y_m[next], at_end_[i]);
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
  // Each interval's samples shrink to four rows, in its own four unknowns; these to rows of all unknowns.
  MatrixXd rows = MatrixXd::Zero(4 * static_cast<Index>(intervals()), size + 1);
  MatrixXd samples;
  each_interval([&](std::size_t interval, const MatrixXd& W) {
    samples.resize(static_cast<Index>(boundaries_[interval + 1] - boundaries_[interval]), 5);
    each_sample_of(interval, [&](std::size_t row, const Eigen::RowVector4d& basis) {
      samples.row(static_cast<Index>(row - boundaries_[interval])) << basis, data_.y_m[row];
    });
    const auto first = static_cast<Index>(4 * interval);
    const Eigen::HouseholderQR<MatrixXd> qr(samples.leftCols(4));
    const VectorXd right = qr.householderQ().transpose() * samples.col(4);
    MatrixXd R = MatrixXd::Zero(4, 4);
    const Index kept = std::min<Index>(4, samples.rows());
    R.topRows(kept) = qr.matrixQR().topRows(kept).triangularView<Eigen::Upper>();
    rows.block(first, 0, 4, size).noalias() = R * W;
    rows.block(first, size, kept, 1) = right.head(kept);
  });
  const Eigen::HouseholderQR<MatrixXd> qr(rows.leftCols(size));
  const Index kept = std::min(size, rows.rows());
  Factored out{MatrixXd::Zero(kept, size), (qr.householderQ().transpose() * rows.col(size)).head(kept)};
  out.R = qr.matrixQR().topRows(kept).triangularView<Eigen::Upper>();
  return out;
}

namespace {

/// The minimum of 1/2 x' H x - g' x. Scaled unknowns; the residual of the optimum is that of the scaled
/// programme. Few unknowns stay on the stack: allocating would cost as much as solving.
template <int kMost>
QuadraticSolution free_minimum(const MatrixXd& H, const VectorXd& g, const VectorXd& shift) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
  const Vector scale = H.diagonal().cwiseSqrt().cwiseInverse(), right = scale.cwiseProduct(g + shift);
  const Matrix scaled = scale.asDiagonal() * H * scale.asDiagonal();
  const Vector x = scaled.llt().solve(right);
  const Vector pull = scaled * x;
  QuadraticSolution out;
  out.kkt.stationarity = (pull - right).cwiseAbs().maxCoeff() /
                         std::max({pull.cwiseAbs().maxCoeff(), right.cwiseAbs().maxCoeff(), 1e-300});
  out.x = scale.cwiseProduct(x);
  out.converged = true;
  return out;
}

}  // namespace

QuadraticSolution PiecewiseForm::solve(const DampingConstraints& constraints, const VectorXd& shift) const {
  const double length_s = (data_.t_s.back() - data_.t_s.front()) / static_cast<double>(intervals());
  const StepBounds bounds(constraints, length_s);
  const Index size = g_.size(), steps = size - 4;
  if (!bounds.any() || steps <= 0) {
    constexpr int kFew = 16;
    return size <= kFew ? free_minimum<kFew>(H_, g_, shift) : free_minimum<Eigen::Dynamic>(H_, g_, shift);
  }
  // Scaled unknowns; the residuals of the optimum are reported for the scaled programme.
  const VectorXd scale = H_.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd H = scale.asDiagonal() * H_ * scale.asDiagonal();
  const VectorXd g = scale.cwiseProduct(g_ + shift);
  QuadraticSolution out;
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
  out.damping_per_s.assign(out.unknowns.data() + 2, out.unknowns.data() + out.unknowns.size() - 1);
  out.boundaries = boundaries_;
  return out;
}

/// Calls visit(row, (1, tau, -I, -J)) for every sample of an interval.
template <typename Visit>
void PiecewiseForm::each_sample_of(std::size_t interval, Visit&& visit) const {
  RunningIntegrals running;
  const std::size_t first = boundaries_[interval];
  for (std::size_t row = first; row < boundaries_[interval + 1]; ++row) {
    if (row > first) running.step_to(row, data_);
    visit(row, Eigen::RowVector4d(1, data_.t_s[row] - data_.t_s[first], -running.I, -running.J));
  }
}

std::vector<double> PiecewiseForm::predict(const VectorXd& unknowns) const {
  std::vector<double> out(data_.t_s.size());
  each_interval([&](std::size_t interval, const MatrixXd& W) {
    const Eigen::Vector4d local = W * unknowns;
    each_sample_of(interval,
                   [&](std::size_t row, const Eigen::RowVector4d& basis) { out[row] = basis * local; });
  });
  return out;
}

std::vector<VectorXd> PiecewiseForm::block_gradients(const VectorXd& unknowns, double block_s) const {
  std::vector<VectorXd> out;
  double start_s = -1e300;
  each_interval([&](std::size_t interval, const MatrixXd& W) {
    const Eigen::Vector4d local = W * unknowns;
    each_sample_of(interval, [&](std::size_t row, const Eigen::RowVector4d& basis) {
      if (data_.t_s[row] - start_s >= block_s) {
        start_s = data_.t_s[row];
        out.push_back(VectorXd::Zero(g_.size()));
      }
      const double left_m = data_.y_m[row] - basis * local;
      out.back() += left_m * (W.transpose() * basis.transpose());
    });
  });
  return out;
}

}  // namespace cartwright
