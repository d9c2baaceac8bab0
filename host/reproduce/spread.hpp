#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace cartwright::reproduce {

/// Mean and standard deviation of draws.
class Spread {
 public:
  void add(double value) {
    ++count_;
    const double away = value - mean_;
    mean_ += away / count_;
    squares_ += away * (value - mean_);
  }
  int count() const { return count_; }
  double mean() const { return mean_; }
  double deviation() const { return count_ > 1 ? std::sqrt(squares_ / (count_ - 1)) : 0; }

 private:
  int count_ = 0;
  double mean_ = 0, squares_ = 0;
};

/// "6.14 ± 0.02": mean and two standard deviations, which have two digits.
inline std::string plus_minus(const Spread& spread) {
  const double width = 2 * spread.deviation();
  const int digits = width > 0 ? std::max(0, 1 - static_cast<int>(std::floor(std::log10(width)))) : 4;
  return fmt::format("{:.{}f} ± {:.{}f}", spread.mean(), digits, width, digits);
}

inline std::string percent(double obtained, double published) {
  return fmt::format("{:+.1f} %", 100 * (obtained / published - 1));
}

}  // namespace cartwright::reproduce
