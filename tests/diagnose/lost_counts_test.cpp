#include "host/diagnose/search/lost_counts.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cartwright {
namespace {

constexpr double kCount_m = 2e-5, kSpeed_m_per_s = 0.3;

/// A minute of uniform motion, read without loss.
Session uniform_motion() {
  Recording r;
  r.file = "run.csv";
  for (int k = 0; k < 60000; ++k) {
    r.t_s.push_back(1e-3 * k);
    r.u_V.push_back(0);
    r.y_m.push_back(kCount_m * std::round(kSpeed_m_per_s * 1e-3 * k / kCount_m));
  }
  Session session;
  session.rig.encoder_resolution_m = kCount_m;
  session.recordings = {r};
  return session;
}

/// Reading short by ten counts from each of these rows on.
std::vector<ReadingJump> losses(const std::vector<std::size_t>& rows) {
  std::vector<ReadingJump> jumps;
  for (const std::size_t row : rows) jumps.push_back({0, row, -10 * kCount_m});
  return jumps;
}

bool like(const std::vector<ReadingJump>& jumps) {
  Session read = uniform_motion();
  for (const ReadingJump& jump : jumps) {
    for (std::size_t k = jump.row; k < read.recordings[0].size(); ++k)
      read.recordings[0].y_m[k] += jump.step_m;
  }
  return like_lost_counts(read, jumps);
}

TEST(LostCounts, ComeAtARate) {
  EXPECT_TRUE(like(losses({5000, 21000, 33000, 42000, 58000})));
  EXPECT_FALSE(like(losses({21000, 21020, 21045, 42000, 42030})));
}

TEST(LostCounts, MayBeLostInSeveralTicks) {
  EXPECT_TRUE(like(losses({5000, 5001, 5003, 21000, 21002, 33000, 33004})));
}

TEST(LostCounts, MayFollowEachOtherCloselyWhereThereAreMany) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 100; row < 60000; row += 400) rows.push_back(row);
  rows.insert(rows.end(), {1030, 9340, 30160});
  EXPECT_TRUE(like(losses(rows)));
}

TEST(LostCounts, AreAtLeastThreeAndAgainstTheMotion) {
  EXPECT_FALSE(like(losses({5000, 21000})));
  std::vector<ReadingJump> gained = losses({5000, 21000, 33000, 42000, 58000});
  for (ReadingJump& jump : gained) jump.step_m *= -1;
  EXPECT_FALSE(like(gained));
}

}  // namespace
}  // namespace cartwright
