#include "host/session/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace cartwright {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

CsvTable read(std::string_view text) {
  auto table = parse_csv(text, "a.csv");
  EXPECT_TRUE(table.has_value()) << (table ? "" : table.error().message);
  return table.value_or(CsvTable{});
}

std::string refusal(std::string_view text) {
  const auto table = parse_csv(text, "a.csv");
  return table ? "accepted" : table.error().message;
}

TEST(CsvReader, TakesWhatForeignProgramsWrite) {
  const std::vector<std::string_view> texts{
      "t_s,y_m\n0,1\n0.5,-2e-3\n",
      "\xef\xbb\xbft_s,y_m\r\n0,1\r\n0.5,-2e-3\r\n",
      "t_s;y_m\n0;1\n0,5;-2e-3\n",
      "t_s\ty_m\n0\t1\n0.5\t-0.002",
      "\"t_s\", \"y_m\"\n 0 , +1\n\n0.50,\"-2e-3\"\n\n",
      "t_s,y_m,\n0,1,\n0.5,-2e-3,\n",
      "t_s,y_m\r0,1\r0.5,-2e-3\r",
  };
  for (const std::string_view text : texts) {
    const CsvTable table = read(text);
    ASSERT_THAT(table.names, ElementsAre("t_s", "y_m")) << text;
    EXPECT_THAT(table.columns[0], ElementsAre(0, 0.5)) << text;
    EXPECT_THAT(table.columns[1], ElementsAre(1, -2e-3)) << text;
  }
}

TEST(CsvReader, AnEmptyCellIsMissing) {
  const CsvTable table = read("t_s,i_A\n0,\n1,2\n2,\"\"\n");
  ASSERT_NE(table.find("i_A"), nullptr);
  EXPECT_TRUE(std::isnan((*table.find("i_A"))[0]));
  EXPECT_EQ((*table.find("i_A"))[1], 2);
  EXPECT_TRUE(std::isnan((*table.find("i_A"))[2]));
  EXPECT_EQ(table.find("u_V"), nullptr);
}

TEST(CsvReader, RefusesWithFileLineAndColumn) {
  EXPECT_THAT(refusal(""), HasSubstr("a.csv:1: no header"));
  EXPECT_THAT(refusal("\n1,2\n"), HasSubstr("a.csv:1: no header"));
  EXPECT_THAT(refusal("t_s,t_s\n1,2\n"), HasSubstr("two columns are named t_s"));
  EXPECT_THAT(refusal("t_s,,y_m\n1,2,3\n"), HasSubstr("column 2 has no name"));
  EXPECT_THAT(refusal("t_s,y_m\n0,1\n\n1\n"), HasSubstr("a.csv:4: 1 cells, the header has 2"));
  EXPECT_THAT(refusal("t_s,y_m\n0,1,2\n"), HasSubstr("a.csv:2: 3 cells"));
  EXPECT_THAT(refusal("t_s,y_m\r\n0,1\r\r\n1\r\n"), HasSubstr("a.csv:4: 1 cells"));
  EXPECT_THAT(refusal(std::string_view("\xff\xfet\0_\0s\0,\0y\0", 12)), HasSubstr("a.csv:1: this is UTF-16"));
}

TEST(CsvReader, LeavesColumnsOfTextOut) {
  const CsvTable table = read("t_s,state,y_m,note\n0,1,2,\n1,idle,3,\"so, \"\"so\"\"\"\n");
  EXPECT_THAT(table.names, ElementsAre("t_s", "y_m"));
  EXPECT_THAT(table.columns[1], ElementsAre(2, 3));
  EXPECT_EQ(table.texts.at("state"), "a.csv:3: state is 'idle', a number is needed");
  EXPECT_THAT(table.texts.at("note"), HasSubstr("a.csv:3: note is 'so, "));
}

TEST(CsvReader, SaysWhyAColumnIsNotThere) {
  const CsvTable table = read("t_s,y_m\n0,1\n1,1 2\n");
  EXPECT_TRUE(table.required("t_s", "a.csv").has_value());
  EXPECT_EQ(table.required("y_m", "a.csv").error().message, "a.csv:3: y_m is '1 2', a number is needed");
  EXPECT_EQ(table.required("u_V", "a.csv").error().message, "a.csv: no column u_V; it has t_s");
}

TEST(CsvReader, EveryMessageIsOneLine) {
  for (const std::string_view text : {"", "a,a\n", "a\n\"x\ny\"\n", "a,b\n1\n"}) {
    EXPECT_EQ(refusal(text).find('\n'), std::string::npos);
  }
}

TEST(CsvWriter, WritesHeaderPointsAndLinefeedsWithTheShortestNumbersThatReturn) {
  const CsvTable table{{"t_s", "y_m"}, {{0, 0.1, 1e-3 + 0.1}, {NAN, -2.275e-5, 1e22}}};
  EXPECT_EQ(to_csv(table), "t_s,y_m\n0,\n0.1,-2.275e-05\n0.101,1e+22\n");
}

TEST(CsvWriter, WhatIsWrittenIsReadBackExactly) {
  CsvTable table{{"t_s", "y_m"}, {{}, {}}};
  double y = 0.1;
  for (int row = 0; row < 2000; ++row) {
    table.columns[0].push_back(row * 1e-3 + 1e-9 * std::sin(row));
    table.columns[1].push_back(y = std::fmod(y * 1.7 + 0.37, 1.0) * 1e-3);
  }
  const CsvTable again = read(to_csv(table));
  EXPECT_EQ(again.names, table.names);
  EXPECT_EQ(again.columns, table.columns);
}

TEST(CsvWriter, NamesBecomeUniqueIdentifiers) {
  EXPECT_THAT(csv_identifiers({"t_s", "motor temp", "motor-temp", "2nd", "", "motor_temp_2"}),
              ElementsAre("t_s", "motor_temp", "motor_temp_2", "x_2nd", "x_", "motor_temp_2_2"));
}

}  // namespace
}  // namespace cartwright
