#include "host/reproduce/published_sinefit.hpp"

#include <cmath>
#include <vector>

#include "host/relay/sine_problem.hpp"

namespace cartwright::reproduce {

double brent_minimum(const std::function<double(double)>& cost, double low, double high, double tolerance) {
  const double golden = 0.5 * (3 - std::sqrt(5.0));
  double x = low + golden * (high - low), second = x, third = x;
  double fx = cost(x), f_second = fx, f_third = fx;
  double step = 0, before_last = 0;
  for (int i = 0; i < 500; ++i) {
    const double middle = 0.5 * (low + high);
    const double near = tolerance + 1e-10 * std::abs(x);
    if (std::abs(x - middle) <= 2 * near - 0.5 * (high - low)) break;
    bool parabola = false;
    if (std::abs(before_last) > near) {
      const double r = (x - second) * (fx - f_third);
      double q = (x - third) * (fx - f_second);
      double p = (x - third) * q - (x - second) * r;
      q = 2 * (q - r);
      if (q > 0) p = -p;
      q = std::abs(q);
      parabola = std::abs(p) < std::abs(0.5 * q * before_last) && p > q * (low - x) && p < q * (high - x);
      if (parabola) {
        before_last = step;
        step = p / q;
        if (x + step - low < 2 * near || high - x - step < 2 * near) step = std::copysign(near, middle - x);
      }
    }
    if (!parabola) {
      before_last = x < middle ? high - x : low - x;
      step = golden * before_last;
    }
    const double u = x + (std::abs(step) >= near ? step : std::copysign(near, step));
    const double fu = cost(u);
    if (fu <= fx) {
      (u < x ? high : low) = x;
      third = second, f_third = f_second;
      second = x, f_second = fx;
      x = u, fx = fu;
    } else {
      (u < x ? low : high) = u;
      if (fu <= f_second || second == x) {
        third = second, f_third = f_second;
        second = u, f_second = fu;
      } else if (fu <= f_third || third == x || third == second) {
        third = u, f_third = fu;
      }
    }
  }
  return x;
}

PublishedSineFit published_sinefit2(std::span<const double> t_s, std::span<const double> y,
                                    double frequency_hz) {
  std::vector<double> cycles(y.size()), cosine(y.size()), sine(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) cycles[i] = frequency_hz * t_s[i];
  cosine_and_sine_of_cycles(cycles.data(), y.size(), cosine.data(), sine.data());
  double ss = 0, sc = 0, cc = 0, ys = 0, yc = 0, yy = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double s = sine[i], c = cosine[i];
    ss += s * s;
    sc += s * c;
    cc += c * c;
    ys += y[i] * s;
    yc += y[i] * c;
    yy += y[i] * y[i];
  }
  const double determinant = ss * cc - sc * sc;
  const double by_sine = (cc * ys - sc * yc) / determinant, by_cosine = (ss * yc - sc * ys) / determinant;
  const double left = yy - by_sine * ys - by_cosine * yc;
  return {std::hypot(by_sine, by_cosine), frequency_hz, std::atan2(by_cosine, by_sine),
          std::sqrt(std::max(0.0, left) / static_cast<double>(y.size() - 1))};
}

PublishedSineFit published_sinefit(std::span<const double> t_s, std::span<const double> y, double rough_hz) {
  const auto cost = [&](double frequency_hz) { return published_sinefit2(t_s, y, frequency_hz).rms; };
  return published_sinefit2(t_s, y, brent_minimum(cost, 0.5 * rough_hz, 2 * rough_hz, 1e-6));
}

}  // namespace cartwright::reproduce
