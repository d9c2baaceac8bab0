#include "tests/blind/measures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "host/statistics/binomial.hpp"
#include "tests/blind/benchmark_page.hpp"
#include "tests/blind/saved.hpp"

namespace cartwright::blind {
namespace {

Outcome outcome(const std::string& hidden, const std::string& named, double confidence,
                Size size = Size::medium, std::uint64_t seed = 1) {
  Outcome o;
  o.asked = {{hidden}, size, seed};
  o.expected = {hidden};
  o.verdict = named.empty() ? Verdict::no_mismatch : Verdict::missing_physics;
  if (!named.empty()) o.named.push_back({named, confidence, named == hidden, {}});
  o.window_error_m = 2e-4, o.noise_floor_m = 1e-4, o.time_s = 5;
  return o;
}

const Measure* find(const std::vector<Measure>& list, const std::string& name) {
  for (const Measure& m : list) {
    if (m.name == name) return &m;
  }
  return nullptr;
}

TEST(BinomialShare, IsWhatClopperAndPearsonGive) {
  // None of n: 1 - (0.025)^(1/n); all of n: its mirror image.
  EXPECT_NEAR(binomial_share(0, 200).high, 1 - std::pow(0.025, 1 / 200.0), 1e-9);
  EXPECT_EQ(binomial_share(0, 200).low, 0);
  EXPECT_NEAR(binomial_share(44, 44).low, std::pow(0.025, 1 / 44.0), 1e-9);
  // At the upper bound, as few or fewer come up once in forty: here 1 of 3, (1-p)^3 + 3 p (1-p)^2 = 0.025.
  const double p = binomial_share(1, 3).high;
  EXPECT_NEAR(std::pow(1 - p, 3) + 3 * p * std::pow(1 - p, 2), 0.025, 1e-9);
  EXPECT_TRUE(std::isnan(binomial_share(0, 0).value));
}

TEST(Quantile, LiesBetweenOrderStatisticsAndLeavesOutWhatIsNoNumber) {
  std::vector<double> values{std::nan("")};
  for (int i = 0; i <= 100; ++i) values.push_back(100 - i);
  const Estimate median = quantile(values, 0.5);
  EXPECT_DOUBLE_EQ(median.value, 50);
  EXPECT_LT(median.low, 42);
  EXPECT_GT(median.high, 58);
  EXPECT_DOUBLE_EQ(quantile(values, 0.9).value, 90);
  EXPECT_DOUBLE_EQ(quantile(values, 1).value, 100);
  EXPECT_TRUE(std::isnan(quantile({}, 0.5).value));
}

TEST(Measures, CountNamesRefusalsAndFalseAlarms) {
  Outcomes list{outcome("cogging", "cogging", 0.9), outcome("cogging", "backlash", 0.6),
                outcome("cable_spring", "", 0)};
  list[0].baselines["BIC"] = {"cogging"};
  list[1].baselines["BIC"] = {"cogging", "backlash"};
  Outcome clean;
  clean.verdict = Verdict::unexplained;
  Outcome outside;
  outside.asked = {{"x_slew"}, Size::large, 1};
  outside.verdict = Verdict::unexplained;
  list.push_back(clean);
  list.push_back(outside);
  const std::vector<Measure> found = measures(list);
  const Measure* first = find(found, "named first, medium");
  ASSERT_NE(first, nullptr);
  EXPECT_NEAR(first->reached.value, 100.0 / 3, 1e-9);
  EXPECT_EQ(first->cases, 3u);
  EXPECT_FALSE(first->met);
  EXPECT_DOUBLE_EQ(first->baselines.at("BIC").value, 100);
  const Measure* wrong = find(found, "a wrong name given to an effect of the vocabulary");
  EXPECT_NEAR(wrong->reached.value, 100.0 / 3, 1e-9);
  EXPECT_DOUBLE_EQ(wrong->baselines.at("BIC").value, 50);
  EXPECT_DOUBLE_EQ(find(found, "false alarms where nothing is hidden")->reached.value, 100);
  EXPECT_DOUBLE_EQ(find(found, "medium and large physics without a name refused")->reached.value, 100);
  EXPECT_EQ(find(found, "both of two medium effects named"), nullptr);
}

TEST(Reliability, PutsNamesOfLikeConfidenceTogether) {
  const Outcomes list{outcome("cogging", "cogging", 0.97), outcome("cogging", "cogging", 1.0),
                      outcome("cogging", "backlash", 0.45), outcome("cogging", "cogging", 0.35)};
  const std::vector<ReliabilityBin> bins = reliability(list);
  ASSERT_EQ(bins.size(), 2u);
  EXPECT_EQ(bins[0].names, 2);
  EXPECT_EQ(bins[0].right, 1);
  EXPECT_DOUBLE_EQ(bins[0].stated, 0.4);
  EXPECT_DOUBLE_EQ(bins[1].share_right.value, 1);
}

TEST(Detection, GrowsWithTheExcessThatSortsIt) {
  Outcomes list;
  for (int i = 1; i <= 8; ++i) {
    list.push_back(outcome("cogging", i > 4 ? "cogging" : "", 1, Size::small));
    list.back().window_error_m = list.back().noise_floor_m * std::sqrt(1 + i * i);
  }
  EXPECT_NEAR(list[2].excess_over_floor(), 3, 1e-12);
  const std::vector<Detection> groups = detection_by_excess(list, 2);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].named_first.value, 0);
  EXPECT_EQ(groups[1].named_first.value, 1);
  EXPECT_NEAR(groups[0].excess_over_floor, std::pow(1 * 2 * 3 * 4, 0.25), 1e-12);
  EXPECT_EQ(detection_by_size(list).size(), 1u);
}

TEST(SavedOutcomes, ComeBackAsTheyWere) {
  const auto file = std::filesystem::temp_directory_path() / "cartwright_saved_outcomes_test.jsonl";
  std::filesystem::remove(file);
  EXPECT_TRUE(read_outcomes(file)->empty());
  Outcome o = outcome("cogging", "cogging", 0.9, Size::small, 103);
  o.parameters = {{"cogging.period_m", 0.25, true}};
  o.unseen_excess_removed = std::nan("");
  o.named.front().evidence.gain_nats = 31;
  o.baselines["BIC"] = {"cogging", "backlash"};
  ASSERT_TRUE(append_outcome(o, file));
  o.time_s = 7;  // asked again: the later answer counts
  ASSERT_TRUE(append_outcome(o, file));
  std::ofstream(file, std::ios::app) << "{\"effects\": [\"cog";  // stopped while it wrote
  drop_unfinished_line(file);
  const auto back = read_outcomes(file);
  ASSERT_TRUE(back);
  ASSERT_EQ(back->size(), 1u);
  EXPECT_EQ(to_line(back->front()), to_line(o));
  EXPECT_TRUE(std::isinf(back->front().named.front().evidence.margin_nats));
  std::ofstream(file, std::ios::app) << "{\"effects\": 3}\n";
  const auto broken = read_outcomes(file);
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.error().message.find("line 3"), std::string::npos);
  std::filesystem::remove(file);
}

TEST(Cases, AllIsEverySetAndNoCartTwice) {
  Draws draws;
  draws.sizes = {0, 3};
  draws.seeds = 2;
  const std::vector<Case> all = cases_of("all", draws);
  std::size_t sum = 0;
  for (const std::string& set : sets()) sum += cases_of(set, draws).size();
  EXPECT_EQ(all.size(), sum);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(all[i] == all[j]);
  }
}

TEST(BenchmarkPage, HoldsMeasuresAndMisses) {
  const std::string html =
      benchmark_page({outcome("cogging", "cogging", 0.9), outcome("cogging", "backlash", 0.6)}).to_html();
  EXPECT_NE(html.find("named first, medium"), std::string::npos);
  EXPECT_NE(html.find("Not named first: 1 sessions"), std::string::npos);
}

}  // namespace
}  // namespace cartwright::blind
