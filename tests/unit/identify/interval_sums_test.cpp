#include "host/identify/interval_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace cartwright {
namespace {

/// Uneven times, readings and a held voltage.
struct Rows {
  std::vector<double> t_s, y_m, held;

  explicit Rows(std::size_t count) {
    std::mt19937_64 random(count);
    std::uniform_real_distribution<double> step(0.5e-3, 1.5e-3), value(-1, 1);
    double t = 3;
    for (std::size_t i = 0; i < count; ++i) {
      t_s.push_back(t += step(random));
      y_m.push_back(0.1 + 0.05 * value(random));
      held.push_back(12 * value(random));
    }
  }
};

/// Row by row, as the integrals are defined.
IntervalSums row_by_row(const IntegralData& data, std::size_t first, std::size_t last) {
  IntervalSums out;
  out.gram.setZero();
  out.right.setZero();
  RunningIntegrals r;
  for (std::size_t row = first; row < last; ++row) {
    if (row > first) r.step_to(row, data);
    const Eigen::Vector4d basis(1, data.t_s[row] - data.t_s[first], -r.I, -r.J);
    out.gram += basis * basis.transpose();
    out.right += basis * data.y_m[row];
  }
  if (last < data.t_s.size()) r.step_to(last, data);
  out.at_end = r;
  return out;
}

TEST(IntervalSums, AreThoseOfTheRowsOneByOneWhateverTheirNumber) {
  // All remainders of a division by four lanes, too few rows to fill them, and the last rows of a record.
  const Rows rows(400);
  for (const bool with_voltage : {false, true}) {
    const IntegralData data{rows.t_s, rows.y_m,
                            with_voltage ? std::span<const double>(rows.held) : std::span<const double>()};
    for (const std::size_t first : {0u, 7u}) {
      for (std::size_t last = first + 1; last <= rows.t_s.size(); last += last < 40 ? 1 : 45) {
        const IntervalSums sums = interval_sums(data, first, last), truth = row_by_row(data, first, last);
        const Eigen::Vector4d size = truth.gram.diagonal().cwiseSqrt();
        for (int i = 0; i < 4; ++i) {
          for (int j = 0; j < 4; ++j)
            EXPECT_NEAR(sums.gram(i, j), truth.gram(i, j), 1e-13 * size[i] * size[j]) << first << " " << last;
          EXPECT_NEAR(sums.right[i], truth.right[i], 1e-13 * size[i] * std::sqrt(static_cast<double>(last)))
              << last;
        }
        EXPECT_NEAR(sums.at_end.I, truth.at_end.I, 1e-15);
        EXPECT_NEAR(sums.at_end.S, truth.at_end.S, 1e-14);
        EXPECT_NEAR(sums.at_end.J, truth.at_end.J, 1e-15);
      }
    }
  }
}

TEST(IntervalSums, OfNoRowsAreNothing) {
  const Rows rows(8);
  for (const std::size_t at : {0u, 3u, 8u}) {
    const IntervalSums sums = interval_sums({rows.t_s, rows.y_m, {}}, at, at);
    EXPECT_EQ(sums.gram.cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(sums.right.cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(sums.at_end.J, 0);
  }
}

}  // namespace
}  // namespace cartwright
