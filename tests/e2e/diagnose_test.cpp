#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/e2e/process.hpp"

namespace cartwright::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A battery on the simulated cart of the examples, whose readings are rounded and nothing else.
class DiagnoseCommand : public testing::Test {
 protected:
  void SetUp() override {
    const Finished ready =
        run("/bin/sh", {"-c", "cd " + scratch_.text("") +
                                  " && cp " CARTWRIGHT_EXAMPLES "/* . && " CARTWRIGHTD_PROGRAM
                                  " --rig simulated.toml --virtual --once battery --out session"});
    ASSERT_EQ(ready.status, 0) << ready.err;
  }

  json diagnosis() const {
    const Finished finished = cartwright({"diagnose", "--model", scratch_.text("cart.toml"), "--session",
                                          scratch_.text("session"), "--out", scratch_.text("out"), "--json"});
    EXPECT_EQ(finished.status, 0) << finished.err;
    return json::parse(finished.out);
  }

  Scratch scratch_;
};

TEST_F(DiagnoseCommand, FindsNothingOnTheCartThatTheModelIs) {
  scratch_.put("out/missing_force.csv", "of an earlier run\n");
  const json d = diagnosis();
  EXPECT_EQ(d["verdict"], "no_mismatch");
  EXPECT_TRUE(d["unexplained"].is_null());
  EXPECT_FALSE(std::filesystem::exists(scratch_ / "out/missing_force.csv"));
  EXPECT_TRUE(std::filesystem::exists(scratch_ / "out/report.html"));
}

TEST_F(DiagnoseCommand, SaysWhereRowsAreMissing) {
  const std::filesystem::path recording = scratch_ / "session/sweep.csv";
  std::vector<std::string> lines;
  std::ifstream in(recording);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  ASSERT_GT(lines.size(), 1500u);
  std::ofstream out(recording);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (i < 1000 || i >= 1300) out << lines[i] << "\n";
  out.close();
  EXPECT_THAT(diagnosis()["remarks"].dump(), HasSubstr("sweep.csv: 300 rows are missing in 1 gap"));
}

}  // namespace
}  // namespace cartwright::test
