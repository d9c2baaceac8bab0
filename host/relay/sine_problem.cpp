#include "host/relay/sine_problem.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "host/relay/vector_sums.hpp"
#include "host/vector_clones.hpp"

namespace cartwright {
namespace {

constexpr std::size_t kBlock = 256;

/// Coefficients of sin(pi r)/r or cos(pi r) in powers of z = r^2, for |r| <= 1/2: the Taylor series, eleven
/// terms of which reach 2e-17, economised to fewer (Lanczos): of its last power, the multiple of the
/// Chebyshev polynomial T*(4 z) that cancels it is taken away, which is nowhere greater than 1.
template <std::size_t kTerms>
constexpr std::array<double, kTerms> economised(bool cosine) {
  constexpr std::size_t kTaylor = 13;
  std::array<double, kTaylor> c{};
  double term = cosine ? 1 : std::numbers::pi;
  for (std::size_t i = 0; i < kTaylor; ++i) {
    c[i] = term;
    const double n = static_cast<double>(2 * i) + (cosine ? 1 : 2);
    term *= -std::numbers::pi * std::numbers::pi / (n * (n + 1));
  }
  // T*_n(x) on [0, 1]: T*_0 = 1, T*_1 = 2 x - 1, T*_(n+1) = (4 x - 2) T*_n - T*_(n-1).
  std::array<std::array<double, kTaylor>, kTaylor> chebyshev{};
  chebyshev[0][0] = 1;
  chebyshev[1][0] = -1, chebyshev[1][1] = 2;
  for (std::size_t n = 2; n < kTaylor; ++n) {
    for (std::size_t i = 0; i <= n; ++i) {
      chebyshev[n][i] =
          (i > 0 ? 4 * chebyshev[n - 1][i - 1] : 0) - 2 * chebyshev[n - 1][i] - chebyshev[n - 2][i];
    }
  }
  for (std::size_t last = kTaylor - 1; last >= kTerms; --last) {
    // In powers of x = 4 z the coefficient of x^i is c_i / 4^i.
    double share = c[last] / chebyshev[last][last];
    for (std::size_t i = last; i > 0; --i) share /= 4;
    double power = 1;
    for (std::size_t i = 0; i <= last; ++i, power *= 4) c[i] -= share * chebyshev[last][i] * power;
  }
  std::array<double, kTerms> out{};
  for (std::size_t i = 0; i < kTerms; ++i) out[i] = c[i];
  return out;
}
/// As few as keep the error of one below rounding.
constexpr auto kSine = economised<9>(false);
constexpr auto kCosine = economised<9>(true);

void multiply(const double* a, const double* b, std::size_t count, double* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = a[i] * b[i];
}

void next_harmonic(const double* c1, const double* s1, const double* c, const double* s, std::size_t count,
                   double* __restrict next_c, double* __restrict next_s) {
  for (std::size_t i = 0; i < count; ++i) {
    next_c[i] = c1[i] * c[i] - s1[i] * s[i];
    next_s[i] = s1[i] * c[i] + c1[i] * s[i];
  }
}

}  // namespace

CARTWRIGHT_VECTOR_CLONES void cosine_and_sine_of_cycles(const double* cycles, std::size_t count,
                                                        double* __restrict cosine, double* __restrict sine) {
  // Adding and taking away 1.5 * 2^52 rounds to the nearest integer, in two additions that vectorise.
  constexpr double kRounder = 6755399441055744.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double r = cycles[i] - ((cycles[i] + kRounder) - kRounder);
    const double r2 = r * r;
    double s = kSine.back(), c = kCosine.back();
    for (std::size_t k = kSine.size() - 1; k-- > 0;) s = s * r2 + kSine[k];
    for (std::size_t k = kCosine.size() - 1; k-- > 0;) c = c * r2 + kCosine[k];
    s *= r;
    cosine[i] = 1 - 2 * s * s;
    sine[i] = 2 * s * c;
  }
}

SineProblem::SineProblem(std::span<const double> t_s, std::span<const double> y, int harmonics)
    : harmonics_(harmonics), tau_s_(t_s.begin(), t_s.end()), x_(t_s.size()), y_(y.begin(), y.end()) {
  centre_s_ = 0.5 * (t_s.front() + t_s.back());
  half_span_s_ = 0.5 * (t_s.back() - t_s.front());
  mean_ = sum(y_.data(), size()) / static_cast<double>(size());
  const double scale = 1 / half_span_s_;
  for (std::size_t i = 0; i < size(); ++i) {
    tau_s_[i] -= centre_s_;
    x_[i] = tau_s_[i] * scale;
    y_[i] -= mean_;
  }
  base_(0, 0) = static_cast<double>(size());
  base_(0, 1) = sum(x_.data(), size());
  base_(0, 2) = sum(y_.data(), size());
  base_(1, 1) = sum_of_squares(x_.data(), size());
  base_(1, 2) = sum_of_products(x_.data(), y_.data(), size());
  base_(2, 2) = sum_of_squares(y_.data(), size());
  base_ = Eigen::Matrix3d(base_.selfadjointView<Eigen::Upper>());
}

namespace {

/// Sums over samples of one harmonic's columns.
struct FundamentalSums {
  enum Of : std::size_t { c, s, xc, xs, xxc, xxs, yc, ys, yxc, yxs, cc, cs, xcc, xcs, xxcc, xxcs, how_many };
  Lanes lanes[how_many] = {};

  double operator()(Of of) const { return total(lanes[of]); }
};

/// Adds a block, in three passes over what is in the cache, so that the partial sums stay in registers. The
/// block is a multiple of the lanes long; what fills it up counts as cos = sin = 0.
CARTWRIGHT_VECTOR_CLONES void add_block(const double* x_at, const double* y_at, const double* cosine,
                                        const double* sine, std::size_t count, FundamentalSums& sums) {
  using F = FundamentalSums;
  const auto* x = reinterpret_cast<const LanesAt*>(x_at);
  const auto* y = reinterpret_cast<const LanesAt*>(y_at);
  const auto* c = reinterpret_cast<const LanesAt*>(cosine);
  const auto* s = reinterpret_cast<const LanesAt*>(sine);
  const std::size_t steps = count / kLanes;
  Lanes a0{}, a1{}, a2{}, a3{}, a4{}, a5{};
  for (std::size_t i = 0; i < steps; ++i) {
    const Lanes xc = x[i] * c[i], xs = x[i] * s[i];
    a0 += c[i];
    a1 += s[i];
    a2 += xc;
    a3 += xs;
    a4 += x[i] * xc;
    a5 += x[i] * xs;
  }
  sums.lanes[F::c] += a0, sums.lanes[F::s] += a1, sums.lanes[F::xc] += a2;
  sums.lanes[F::xs] += a3, sums.lanes[F::xxc] += a4, sums.lanes[F::xxs] += a5;
  a0 = a1 = a2 = a3 = Lanes{};
  for (std::size_t i = 0; i < steps; ++i) {
    const Lanes yc = y[i] * c[i], ys = y[i] * s[i];
    a0 += yc;
    a1 += ys;
    a2 += x[i] * yc;
    a3 += x[i] * ys;
  }
  sums.lanes[F::yc] += a0, sums.lanes[F::ys] += a1, sums.lanes[F::yxc] += a2, sums.lanes[F::yxs] += a3;
  a0 = a1 = a2 = a3 = a4 = a5 = Lanes{};
  for (std::size_t i = 0; i < steps; ++i) {
    const Lanes cc = c[i] * c[i], cs = c[i] * s[i], xcc = x[i] * cc, xcs = x[i] * cs;
    a0 += cc;
    a1 += cs;
    a2 += xcc;
    a3 += xcs;
    a4 += x[i] * xcc;
    a5 += x[i] * xcs;
  }
  sums.lanes[F::cc] += a0, sums.lanes[F::cs] += a1, sums.lanes[F::xcc] += a2;
  sums.lanes[F::xcs] += a3, sums.lanes[F::xxcc] += a4, sums.lanes[F::xxcs] += a5;
}

}  // namespace

/// One harmonic: the sums that are left once cos^2 + sin^2 = 1 is used.
Eigen::MatrixXd SineProblem::products_of_fundamental(double frequency_hz) const {
  using F = FundamentalSums;
  FundamentalSums sums;
  std::array<double, kBlock> cycles, cosine, sine;
  for (std::size_t begin = 0; begin < size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, size() - begin), whole = count - count % kLanes;
    for (std::size_t i = 0; i < count; ++i) cycles[i] = frequency_hz * tau_s_[begin + i];
    cosine_and_sine_of_cycles(cycles.data(), count, cosine.data(), sine.data());
    add_block(x_.data() + begin, y_.data() + begin, cosine.data(), sine.data(), whole, sums);
    if (whole == count) continue;
    // The last few, in a block of their own filled up with zeros.
    std::array<double, kLanes> x{}, y{}, c{}, s{};
    for (std::size_t i = whole; i < count; ++i) {
      x[i - whole] = x_[begin + i];
      y[i - whole] = y_[begin + i];
      c[i - whole] = cosine[i];
      s[i - whole] = sine[i];
    }
    add_block(x.data(), y.data(), c.data(), s.data(), kLanes, sums);
  }
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(7, 7);
  out.topLeftCorner<3, 3>() = base_;
  out.block<3, 4>(0, 3) << sums(F::c), sums(F::s), sums(F::xc), sums(F::xs),  //
      sums(F::xc), sums(F::xs), sums(F::xxc), sums(F::xxs),                   //
      sums(F::yc), sums(F::ys), sums(F::yxc), sums(F::yxs);
  out.block<4, 4>(3, 3) << sums(F::cc), sums(F::cs), sums(F::xcc), sums(F::xcs),  //
      0, base_(0, 0) - sums(F::cc), sums(F::xcs), base_(0, 1) - sums(F::xcc),     //
      0, 0, sums(F::xxcc), sums(F::xxcs),                                         //
      0, 0, 0, base_(1, 1) - sums(F::xxcc);
  return out.selfadjointView<Eigen::Upper>();
}

/// Columns: 1, x, y, then for each harmonic cos, sin, x cos, x sin.
Eigen::MatrixXd SineProblem::products(double frequency_hz) const {
  if (harmonics_ == 1) return products_of_fundamental(frequency_hz);
  const auto columns = static_cast<std::size_t>(3 + 4 * harmonics_);
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(3 + 4 * harmonics_, 3 + 4 * harmonics_);
  sums.topLeftCorner<3, 3>() = base_;
  std::vector<double> storage(columns * kBlock, 0.0);
  const auto column = [&storage](std::size_t i) { return storage.data() + i * kBlock; };
  std::array<double, kBlock> cycles;
  std::fill_n(column(0), kBlock, 1.0);
  for (std::size_t begin = 0; begin < size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, size() - begin);
    for (std::size_t i = 0; i < count; ++i) cycles[i] = frequency_hz * tau_s_[begin + i];
    std::copy_n(x_.data() + begin, count, column(1));
    std::copy_n(y_.data() + begin, count, column(2));
    cosine_and_sine_of_cycles(cycles.data(), count, column(3), column(4));
    for (std::size_t c = 3; c < columns; c += 4) {
      if (c > 3)
        next_harmonic(column(3), column(4), column(c - 4), column(c - 3), count, column(c), column(c + 1));
      multiply(column(1), column(c), count, column(c + 2));
      multiply(column(1), column(c + 1), count, column(c + 3));
    }
    for (std::size_t j = 3; j < columns; ++j) {
      for (std::size_t i = 0; i <= j; ++i) {
        sums(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) +=
            sum_of_products(column(i), column(j), count);
      }
    }
  }
  return sums.selfadjointView<Eigen::Upper>();
}

SineProblem::Point SineProblem::solve(double frequency_hz, const Eigen::MatrixXd& z, bool with_trend) const {
  const Eigen::Index constants = with_trend ? 2 : 1;
  const Eigen::Index linear = constants + 2 * harmonics_;
  Eigen::VectorXi column(linear);
  column(0) = 0;
  if (with_trend) column(1) = 1;
  for (int k = 0; k < harmonics_; ++k) {
    column(constants + 2 * k) = 3 + 4 * k;
    column(constants + 2 * k + 1) = 4 + 4 * k;
  }
  Eigen::MatrixXd normal(linear + 1, linear + 1);
  Eigen::VectorXd right(linear);
  for (Eigen::Index i = 0; i < linear; ++i) {
    right(i) = z(column(i), 2);
    for (Eigen::Index j = 0; j < linear; ++j) normal(i, j) = z(column(i), column(j));
  }
  Point point;
  point.frequency_hz = frequency_hz;
  point.linear = normal.topLeftCorner(linear, linear).ldlt().solve(right);
  // Derivative with respect to 2 pi f half_span: sum of k x (b_k cos - a_k sin), a combination of the
  // columns.
  Eigen::VectorXd derivative = Eigen::VectorXd::Zero(z.cols());
  for (int k = 0; k < harmonics_; ++k) {
    derivative(5 + 4 * k) = (k + 1) * point.linear(constants + 2 * k + 1);
    derivative(6 + 4 * k) = -(k + 1) * point.linear(constants + 2 * k);
  }
  Eigen::VectorXd model = Eigen::VectorXd::Zero(z.cols());
  for (Eigen::Index i = 0; i < linear; ++i) model(column(i)) = point.linear(i);
  const Eigen::VectorXd z_derivative = z * derivative;
  for (Eigen::Index i = 0; i < linear; ++i) normal(i, linear) = normal(linear, i) = z_derivative(column(i));
  normal(linear, linear) = derivative.dot(z_derivative);
  model(2) = -1;  // model less measurement
  const Eigen::VectorXd z_error = z * model;
  point.cost = std::max(0.0, model.dot(z_error));
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(linear + 1);
  gradient(linear) = -derivative.dot(z_error);
  const auto factors = normal.ldlt();
  point.covariance = factors.solve(Eigen::MatrixXd::Identity(linear + 1, linear + 1));
  point.step_rad = point.covariance.row(linear).dot(gradient);
  return point;
}

double SineProblem::cost_without_sine(bool with_trend) const {
  const double n = base_(0, 0), sx = base_(0, 1), sy = base_(0, 2);
  const double yy = base_(2, 2) - sy * sy / n;
  if (!with_trend) return yy;
  const double xx = base_(1, 1) - sx * sx / n, xy = base_(1, 2) - sx * sy / n;
  return yy - xy * xy / xx;
}

std::vector<double> SineProblem::residual(const Point& point, bool with_trend) const {
  const Eigen::Index constants = with_trend ? 2 : 1;
  std::vector<double> out(size());
  std::array<double, kBlock> cycles, c1, s1, c, s, next_c, next_s;
  for (std::size_t begin = 0; begin < size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, size() - begin);
    double* left = out.data() + begin;
    for (std::size_t i = 0; i < count; ++i) cycles[i] = point.frequency_hz * tau_s_[begin + i];
    cosine_and_sine_of_cycles(cycles.data(), count, c1.data(), s1.data());
    const double slope = with_trend ? point.linear(1) : 0;
    for (std::size_t i = 0; i < count; ++i) left[i] = y_[begin + i] - point.linear(0) - slope * x_[begin + i];
    c = c1;
    s = s1;
    for (int k = 0; k < harmonics_; ++k) {
      const double by_cosine = point.linear(constants + 2 * k), by_sine = point.linear(constants + 2 * k + 1);
      for (std::size_t i = 0; i < count; ++i) left[i] -= by_cosine * c[i] + by_sine * s[i];
      if (k + 1 == harmonics_) break;
      next_harmonic(c1.data(), s1.data(), c.data(), s.data(), count, next_c.data(), next_s.data());
      std::swap(c, next_c);
      std::swap(s, next_s);
    }
  }
  return out;
}

}  // namespace cartwright
