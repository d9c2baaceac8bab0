#include "host/report/report.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "host/report/html.hpp"

namespace cartwright::report {
namespace {

using ::testing::HasSubstr;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++found;
  return found;
}

TEST(Table, IntervalsStandBesideTheirNumbersOrBelowThem) {
  Table table;
  table.columns = {{"value"}};
  table.row({Cell(Estimate{2, 1.9, 2.1})});
  const std::string beside = to_html(table);
  table.intervals_below = true;
  const std::string below = to_html(table);
  EXPECT_NE(beside.find("colspan=\"2\""), std::string::npos);
  EXPECT_EQ(below.find("colspan"), std::string::npos);
  EXPECT_NE(below.find("<span class=\"below\">["), std::string::npos);
}

TEST(ReportNumber, ShowsTwoDigitsOfTheHalfWidthAndNoMore) {
  const FormattedEstimate shown = format_estimate({1.91304, 1.90812, 1.91797});
  EXPECT_EQ(shown.value, "1.9130");
  EXPECT_EQ(shown.interval, "[1.9081, 1.9180]");
  EXPECT_EQ(format_estimate({203.5034, 180, 227}).value, "204");
}

TEST(ReportNumber, TakesOnePowerOfTenOutOfValueAndBounds) {
  const FormattedEstimate shown = format_estimate({4.1e-5, 3.8e-5, 4.4e-5});
  EXPECT_EQ(shown.value, "4.10×10⁻⁵");
  EXPECT_EQ(shown.interval, "[3.80, 4.40]×10⁻⁵");
}

TEST(ReportNumber, HasNoIntervalWhereABoundIsMissing) {
  EXPECT_EQ(format_estimate({2.5, kNaN, 3}).interval, "");
  EXPECT_EQ(format_estimate({2.5, kNaN, 3}).value, "2.500");
}

TEST(ReportNumber, UsesATrueMinusAndNeverMinusZero) {
  EXPECT_EQ(format_number(-3.165), "−3.165");
  EXPECT_EQ(format_estimate({-0.0001, -1, 1}).value, "0.0");
  EXPECT_EQ(format_number(kNaN), "–");
}

TEST(ReportHtml, EscapesEverythingThatComesFromOutside) {
  Report page{"<script>alert(1)</script>", "a & b"};
  page.section("\"quoted\" <b>");
  page.paragraph("x < y");
  page.table({"<i>", {{"<u>", "<s>"}}, {{Cell("<em>")}}, "<q>"});
  Plot plot;
  plot.title = "</script><script>alert(2)</script>";
  plot.add({.name = "</script>", .x = {0, 1}, .y = {0, 1}});
  page.plot(plot);
  const std::string html = page.to_html();
  for (const char* tag : {"<script>alert", "<b>", "<i>", "<u>", "<s>", "<em>", "<q>"})
    EXPECT_EQ(count(html, tag), 0u) << tag;
  EXPECT_EQ(count(html, "</script>"), 2u) << "the data and the code end once each";
}

TEST(ReportHtml, LoadsNothingFromAnywhere) {
  Report page{"Page"};
  Plot plot;
  plot.add({.x = {0, 1, 2}, .y = {0, 1, 0}});
  page.plot(plot);
  const std::string html = page.to_html();
  for (const char* part : {"http:", "https:", "src=", "@import", "url(\"", "<link"})
    EXPECT_EQ(count(html, part), 0u) << part;
}

TEST(ReportHtml, SameCallsGiveSameBytes) {
  const auto make = [] {
    Report page{"Page"};
    Plot plot;
    plot.add({.name = "y", .x = {0, 0.1, 0.3}, .y = {kNaN, 1, std::numbers::pi}});
    return page.section("Same").section("Same").plot(plot).to_html();
  };
  EXPECT_EQ(make(), make());
  EXPECT_EQ(count(make(), "id=\"same-2\""), 1u) << "two sections of one name need two anchors";
}

TEST(ReportTable, PutsIntervalsIntoAColumnOfTheirOwn) {
  Table table;
  table.columns = {{"Parameter", ""}, {"Value", "1/s"}};
  table.row({"viscous", Estimate{5, 4.9, 5.1}}).row({"none", Estimate{5}});
  const std::string html = to_html(table);
  EXPECT_THAT(html, HasSubstr("colspan=\"2\""));
  EXPECT_EQ(count(html, "<td class=\"i\">"), 2u);
  EXPECT_EQ(count(html, "<td"), 6u) << "every row has as many cells as the head says";
}

TEST(ReportThinning, HeldValuesKeepTheirEnds) {
  const Thinned thin = without_straight_runs({0, 1, 2, 3, 4, 5, 6}, {0, 0, 0, 1, 1, 1, 1});
  EXPECT_THAT(thin.x, ::testing::ElementsAre(0, 2, 3, 6));
  EXPECT_THAT(thin.y, ::testing::ElementsAre(0, 0, 1, 1));
}

TEST(ReportThinning, ASingleSpikeSurvivesTheBudget) {
  std::vector<double> x(1000000), y(1000000);
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] = static_cast<double>(i);
    y[i] = std::sin(1e-4 * x[i]);
  }
  y[765432] = 9;
  y[123456] = -9;
  const Thinned thin = least_and_greatest(x, y, 4000);
  EXPECT_LE(thin.x.size(), 4000u);
  EXPECT_THAT(thin.y, ::testing::Contains(9));
  EXPECT_THAT(thin.y, ::testing::Contains(-9));
  EXPECT_EQ(thin.x.front(), 0);
  EXPECT_EQ(thin.x.back(), 999999);
  EXPECT_TRUE(std::is_sorted(thin.x.begin(), thin.x.end()));
}

TEST(ReportData, KeepsEachArrayOnceAndAnEvenGridAsThreeNumbers) {
  DataPool pool;
  std::vector<double> grid(10001);
  for (std::size_t i = 0; i < grid.size(); ++i) grid[i] = 1e-3 * static_cast<double>(i);
  const std::size_t first = pool.add(grid);
  const std::size_t other = pool.add({3, 1, 4});
  EXPECT_NE(first, other);
  EXPECT_EQ(pool.add(grid), first);
  EXPECT_LT(pool.to_json().size(), 200u);
}

TEST(ReportHistogram, CountsEveryFiniteValueOnce) {
  const Series bars = histogram("errors", {0, 0.1, 0.2, 0.9, 1.0, kNaN}, 10);
  double total = 0;
  for (const double n : bars.y) total += n;
  EXPECT_EQ(total, 5);
  EXPECT_EQ(bars.y.front(), 1);
  EXPECT_EQ(bars.y.back(), 2);
}

TEST(ReportFile, SaysWhereItCannotWrite) {
  const auto written = Report{"Page"}.write("/nonexistent/folder/report.html");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("report.html"));
}

}  // namespace
}  // namespace cartwright::report
