// `cartwright reproduce` from outside: what can be asked for, and what comes back.
#include <gmock/gmock.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "tests/e2e/process.hpp"

namespace cartwright::test {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

TEST(Reproduce, NamesEveryItemAndRunsOneAlone) {
  const Finished list = cartwright({"reproduce", "--list"});
  ASSERT_EQ(list.status, 0) << list.err;
  for (const char* item : {"theorem1", "identification", "table1", "table2", "design", "fig19", "fig20",
                           "table3", "record", "noise", "relay", "adaptive", "motor"}) {
    EXPECT_THAT(list.out, HasSubstr(std::string("\n  ") + item));
  }
  Scratch scratch;
  const Finished one =
      cartwright({"reproduce", "--item", "table1", "--json", "--out", scratch.text("t.html")});
  ASSERT_EQ(one.status, 0) << one.err;
  EXPECT_EQ(one.err, "");
  const auto answer = nlohmann::json::parse(one.out);
  ASSERT_EQ(answer["papers"].size(), 1u);
  EXPECT_EQ(answer["papers"][0]["items"].size(), 8u);
  for (const auto& item : answer["papers"][0]["items"]) {
    EXPECT_FALSE(item["published"].get<std::string>().empty());
    EXPECT_FALSE(item["obtained"].get<std::string>().empty());
    EXPECT_FALSE(item["why"].get<std::string>().empty());
  }
  EXPECT_TRUE(std::filesystem::exists(scratch.text("t.html")));
}

TEST(Reproduce, RefusesWhatIsNotThereInOneLine) {
  Scratch scratch;
  for (const Words& wrong : {Words{"reproduce", "--item", "table9"}, Words{"reproduce", "--paper", "third"},
                             Words{"reproduce", "--paper", "relay", "--item", "table1"},
                             Words{"reproduce", "--item", "table1", "--out", scratch.text("none/t.html")}}) {
    const Finished finished = cartwright(wrong);
    EXPECT_EQ(finished.status, 2) << wrong.back();
    EXPECT_EQ(finished.out, "") << wrong.back();
    EXPECT_EQ(std::count(finished.err.begin(), finished.err.end(), '\n'), 1) << finished.err;
  }
}

}  // namespace
}  // namespace cartwright::test
