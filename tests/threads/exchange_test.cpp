#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

#include "firmware/exchange/histogram.hpp"
#include "firmware/exchange/log_ring.hpp"
#include "firmware/exchange/mailbox.hpp"
#include "firmware/exchange/published.hpp"

namespace cartwright::firmware {
namespace {

TEST(Published, AReaderNeverSeesHalfAValue) {
  struct Value {
    std::array<std::uint64_t, 20> all;
  };
  Published<Value> published;
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    Value value{};
    for (std::uint64_t i = 1; i <= 200'000; ++i) {
      value.all.fill(i);
      published.write(value);
    }
    stop = true;
  });
  std::uint64_t last = 0;
  while (!stop) {
    const Value value = published.read();
    for (const std::uint64_t each : value.all) ASSERT_EQ(each, value.all.front());
    ASSERT_GE(value.all.front(), last);
    last = value.all.front();
  }
  writer.join();
  EXPECT_EQ(published.read().all.back(), 200'000);
}

TEST(Mailbox, EveryLetterArrivesOnceAndWhole) {
  struct Letter {
    int number = 0, copy = 0;
  };
  Mailbox<Letter> box;
  constexpr int kLetters = 20'000;
  std::thread sender([&] {
    for (int i = 1; i <= kLetters;) {
      if (box.post({i, i})) {
        ++i;
      } else {
        std::this_thread::yield();
      }
    }
  });
  for (int expected = 1; expected <= kLetters;) {
    const Letter* letter = box.peek();
    if (!letter) {
      std::this_thread::yield();
      continue;
    }
    ASSERT_EQ(letter->number, expected);
    ASSERT_EQ(letter->copy, expected);
    box.taken();
    ++expected;
  }
  sender.join();
  EXPECT_TRUE(box.empty());
}

TEST(LogRing, AReaderGetsWholeRowsOrNoneWhileTheRingIsOverwritten) {
  LogRing ring(64);
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    LogRecord record;
    for (int i = 0; i < 200'000; ++i) {
      record.t_s = record.r_m = record.y_m = record.truth_v_m_per_s = i;
      ring.append(record);
    }
    stop = true;
  });
  std::array<LogRow, 16> rows;
  std::size_t seen = 0;
  while (!stop) {
    const std::uint64_t first = ring.first_row() + 8;
    const std::size_t count = ring.copy(first, rows);
    for (std::size_t i = 0; i < count; ++i) {
      for (const std::size_t column : {0U, 1U, 2U, 13U}) {
        ASSERT_EQ(rows[i][column], static_cast<double>(first + i));
      }
    }
    seen += count;
  }
  writer.join();
  EXPECT_EQ(ring.rows(), 200'000);
  EXPECT_EQ(ring.copy(199'990, rows), 10);
  EXPECT_EQ(rows[9][0], 199'999);
}

TEST(LogRing, RowsThatAreGoneOrNotYetThereAreSaidToBe) {
  LogRing ring(10);
  std::array<LogRow, 4> rows;
  EXPECT_EQ(ring.copy(0, rows), 0);
  for (int i = 0; i < 25; ++i) ring.append({});
  EXPECT_EQ(ring.first_row(), 16);
  EXPECT_EQ(ring.copy(15, rows), 0);
  EXPECT_EQ(ring.copy(16, rows), 4);
  EXPECT_EQ(ring.copy(25, rows), 0);
}

TEST(Histogram, QuantilesLieWithinABucketOfTheTruth) {
  Histogram histogram;
  EXPECT_EQ(histogram.quantile_ns(0.5), 0);
  for (int i = 1; i <= 100'000; ++i) histogram.add(i);
  for (const double part : {0.01, 0.5, 0.99, 0.999}) {
    EXPECT_GE(histogram.quantile_ns(part), part * 100'000 - 1);
    EXPECT_LE(histogram.quantile_ns(part), part * 100'000 * 1.032 + 1);
  }
  EXPECT_EQ(histogram.greatest_ns(), 100'000);
  EXPECT_EQ(histogram.quantile_ns(1), 100'000);
}

}  // namespace
}  // namespace cartwright::firmware
