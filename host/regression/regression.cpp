#include "host/regression/regression.hpp"

#include <ceres/ceres.h>

#include <chrono>
#include <cmath>
#include <type_traits>

#include "host/regression/piecewise_response.hpp"

namespace cartwright {
namespace {

template <typename T, typename Visit>
void respond(const RegressionData& data, std::size_t intervals, const T* damping, const T& beta, const T& e,
             const T& v, ResponseBy by, Visit&& visit) {
  const PiecewiseResponse<T> response{data, intervals, damping, beta * data.kp_V_per_m};
  if (by == ResponseBy::analytical) {
    response.analytical(e, v, visit);
  } else if (by == ResponseBy::integrated) {
    response.integrated(e, v, visit);
  } else if constexpr (std::is_same_v<T, double>) {
    response.adaptive(e, v, visit);
  }
}

/// Response less measured; parameters c_1 ... c_n, beta, e(0), e'(0).
template <int kIntervals>
struct Residuals {
  RegressionData data;
  ResponseBy by;

  template <typename T>
  bool operator()(const T* parameters, T* residuals) const {
    // A response that overflows is as wrong as can be, but no failure of the evaluation.
    constexpr double kHopeless_m = 1e3;
    respond<T>(data, kIntervals, parameters, parameters[kIntervals], parameters[kIntervals + 1],
               parameters[kIntervals + 2], by, [&](std::size_t row, const T& e) {
                 residuals[row] = is_finite(e) ? T(e - data.e_m[row]) : T(kHopeless_m);
               });
    return true;
  }

  static bool is_finite(double value) { return std::isfinite(value); }
  template <typename Jet>
  static bool is_finite(const Jet& value) {
    return std::isfinite(value.a) && value.v.allFinite();
  }
};

template <int kIntervals>
ceres::CostFunction* cost_function(const RegressionData& data, ResponseBy by) {
  if (by == ResponseBy::adaptive) {
    return new ceres::NumericDiffCostFunction<Residuals<kIntervals>, ceres::CENTRAL, ceres::DYNAMIC,
                                              kIntervals + 3>(
        new Residuals<kIntervals>{data, by}, ceres::TAKE_OWNERSHIP, static_cast<int>(data.t_s.size()));
  }
  return new ceres::AutoDiffCostFunction<Residuals<kIntervals>, ceres::DYNAMIC, kIntervals + 3>(
      new Residuals<kIntervals>{data, by}, static_cast<int>(data.t_s.size()));
}

}  // namespace

RegressionPoint regression_start(const RegressionData& data, std::size_t intervals, double damping_per_s,
                                 double beta) {
  return {std::vector<double>(intervals, damping_per_s), beta, data.e_m.front(), 0};
}

std::vector<double> regression_response(const RegressionData& data, const RegressionPoint& point,
                                        ResponseBy by) {
  std::vector<double> out(data.t_s.size());
  respond<double>(data, point.damping_per_s.size(), point.damping_per_s.data(), point.beta, point.start_m,
                  point.start_m_per_s, by, [&](std::size_t row, double e) { out[row] = e; });
  return out;
}

RegressionFit fit_by_regression(const RegressionData& data, const RegressionPoint& start, ResponseBy by) {
  const auto began = std::chrono::steady_clock::now();
  const std::size_t intervals = start.damping_per_s.size();
  std::vector<double> parameters = start.damping_per_s;
  parameters.insert(parameters.end(), {start.beta, start.start_m, start.start_m_per_s});
  ceres::Problem problem;
  problem.AddResidualBlock(intervals == 1 ? cost_function<1>(data, by) : cost_function<6>(data, by), nullptr,
                           parameters.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-9;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);

  RegressionFit fit;
  fit.time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  fit.point = {{parameters.begin(), parameters.begin() + static_cast<std::ptrdiff_t>(intervals)},
               parameters[intervals],
               parameters[intervals + 1],
               parameters[intervals + 2]};
  fit.converged = summary.termination_type == ceres::CONVERGENCE;
  fit.iterations = static_cast<int>(summary.iterations.size());
  fit.evaluations = summary.num_residual_evaluations + summary.num_jacobian_evaluations;
  fit.evaluation_share =
      (summary.residual_evaluation_time_in_seconds + summary.jacobian_evaluation_time_in_seconds) /
      fit.time_s;
  fit.message = summary.message;
  const auto response = regression_response(data, fit.point, by);
  double squares = 0;
  for (std::size_t row = 0; row < response.size(); ++row) {
    const double error = response[row] - data.e_m[row];
    squares += error * error;
    fit.mean_absolute_m += std::abs(error) / static_cast<double>(response.size());
  }
  fit.rms_m = std::sqrt(squares / static_cast<double>(response.size()));
  return fit;
}

}  // namespace cartwright
