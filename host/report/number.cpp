#include "host/report/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cartwright::report {
namespace {

constexpr int kSmallestPlainExponent = -3, kLargestPlainExponent = 5;

int exponent_of(double value) {
  return value == 0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
}

std::string with_minus(const std::string& text) {
  return text.starts_with('-') ? fmt::format("\u2212{}", text.substr(1)) : text;
}

std::string superscript(int exponent) {
  static const char* const digits[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                       "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
  std::string out;
  for (const char c : std::to_string(exponent)) out += c == '-' ? "\u207b" : digits[c - '0'];
  return out;
}

std::string power_of_ten(int exponent) {
  return exponent == 0 ? "" : fmt::format("\u00d710{}", superscript(exponent));
}

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, std::clamp(decimals, 0, 12));
  // A value that rounds to nothing must not read "-0.00".
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return with_minus(text);
}

/// The power of ten to take out of a number of this size; none for what reads well as it is.
int common_exponent(double size) {
  const int exponent = exponent_of(size);
  return exponent < kSmallestPlainExponent || exponent > kLargestPlainExponent ? exponent : 0;
}

}  // namespace

std::string format_number(double value, int significant) {
  if (std::isnan(value)) return "\u2013";
  if (std::isinf(value)) return value > 0 ? "\u221e" : "\u2212\u221e";
  const int power = common_exponent(value);
  const double mantissa = value / std::pow(10.0, power);
  return fixed(mantissa, significant - 1 - exponent_of(mantissa)) + power_of_ten(power);
}

FormattedEstimate format_estimate(const Estimate& estimate) {
  if (!std::isfinite(estimate.value) || !std::isfinite(estimate.low) || !std::isfinite(estimate.high)) {
    return {format_number(estimate.value), ""};
  }
  const double size = std::max({std::abs(estimate.value), std::abs(estimate.low), std::abs(estimate.high)});
  const int power = common_exponent(size);
  const double scale = std::pow(10.0, power);
  const double half_width = std::abs(estimate.high - estimate.low) / 2 / scale;
  const int finest = 5 - exponent_of(size / scale);
  const int decimals = half_width > 0 ? std::min(1 - exponent_of(half_width), finest) : finest;
  const auto show = [&](double value) { return fixed(value / scale, decimals); };
  const std::string tail = power_of_ten(power);
  return {show(estimate.value) + tail,
          fmt::format("[{}, {}]{}", show(estimate.low), show(estimate.high), tail)};
}

}  // namespace cartwright::report
