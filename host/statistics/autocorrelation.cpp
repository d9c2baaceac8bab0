#include "host/statistics/autocorrelation.hpp"

namespace cartwright {

double errors_per_independent_one(const Eigen::VectorXd& e) {
  const double power = e.squaredNorm();
  double sum = 1;
  for (Eigen::Index lag = 1; lag < e.size() / 4 && power > 0; ++lag) {
    const double r = e.head(e.size() - lag).dot(e.tail(e.size() - lag)) / power;
    if (r <= 0) break;
    sum += 2 * r;
  }
  return sum;
}

}  // namespace cartwright
