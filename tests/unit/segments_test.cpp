#include "host/session/segments.hpp"

#include <gtest/gtest.h>

namespace cartwright {
namespace {

std::vector<double> regular(std::size_t rows, double period_s) {
  std::vector<double> t_s;
  for (std::size_t row = 0; row < rows; ++row) t_s.push_back(static_cast<double>(row) * period_s);
  return t_s;
}

TEST(Segments, ARegularRecordingIsOneStretch) {
  const auto found = segments(regular(100, 1e-3));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first, 0u);
  EXPECT_EQ(found[0].last, 100u);
}

TEST(Segments, AMissingRowIsAGap) {
  auto t_s = regular(100, 1e-3);
  t_s.erase(t_s.begin() + 40);
  const auto found = segments(t_s);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].last, 40u);
  EXPECT_EQ(found[1].first, 40u);
  EXPECT_EQ(found[1].last, 99u);
}

TEST(Segments, ALateTickIsNoGap) {
  auto t_s = regular(100, 1e-3);
  t_s[40] += 0.8e-3;
  EXPECT_EQ(segments(t_s).size(), 1u);
}

TEST(Segments, AnUnevenClockIsNotTornApart) {
  std::vector<double> t_s{0};
  for (int i = 0; i < 200; ++i) t_s.push_back(t_s.back() + 0.01 * (1 + 0.8 * ((i * 7) % 5 - 2) / 2.0));
  EXPECT_EQ(segments(t_s).size(), 1u);
}

}  // namespace
}  // namespace cartwright
