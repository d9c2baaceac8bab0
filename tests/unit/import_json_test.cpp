#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "host/session/files.hpp"
#include "host/session/import.hpp"
#include "host/session/json_rows.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ImportJson : public testing::Test {
 protected:
  ImportJson()
      : directory_(fs::temp_directory_path() /
                   ("cartwright-json-" + std::to_string(getpid()) +
                    testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(directory_);
  }
  ~ImportJson() override { fs::remove_all(directory_); }

  fs::path file(const std::string& name, const std::string& text) {
    EXPECT_TRUE(write_file(directory_ / name, text));
    return directory_ / name;
  }

  fs::path directory_;
};

/// A servo's log: the duty as a 16 bit register, the supply beside it.
constexpr const char* kLog = R"({"motor": "servo", "kp": 100, "log": [
  {"time": 0.000, "angle": 0.00, "duty": 885, "supply": 7.5, "on": true, "note": "start"},
  {"time": 0.005, "angle": 0.01, "duty": 65535, "supply": 7.0, "on": true},
  {"time": 0.010, "angle": 0.03, "duty": 64651, "supply": 8.0, "on": false}]})";
const std::string kChannels =
    "[channels]\nt_s = \"time\"\ny_m = \"angle\"\non = \"on\"\n"
    "u_V = { channel = \"duty\", signed_bits = 16, times = \"supply\", scale = 0.001 }\n";

TEST_F(ImportJson, TwosComplementTimesTheSupplyIsTheVoltage) {
  const auto map = read_import_map(file("map.toml", kChannels));
  ASSERT_TRUE(map) << map.error().message;
  const auto recording = import_recording(file("servo.json", kLog), *map);
  ASSERT_TRUE(recording) << recording.error().message;
  ASSERT_EQ(recording->size(), 3u);
  EXPECT_EQ(recording->file, "servo.csv");
  EXPECT_NEAR(recording->u_V[0], 0.885 * 7.5, 1e-12);
  EXPECT_NEAR(recording->u_V[1], -0.001 * 7.0, 1e-12);
  EXPECT_NEAR(recording->u_V[2], -0.885 * 8.0, 1e-12);
  EXPECT_EQ(recording->other_columns.at("on"), (std::vector<double>{1, 1, 0}));
}

TEST_F(ImportJson, WhatCannotBeReadIsSaid) {
  const auto message = [this](const std::string& log, const std::string& map_text) {
    const auto map = read_import_map(file("map.toml", map_text));
    if (!map) return map.error().message;
    const auto recording = import_recording(file("servo.json", log), *map);
    return recording ? std::string("accepted") : recording.error().message;
  };
  EXPECT_THAT(message("no json", kChannels), HasSubstr("not JSON"));
  EXPECT_THAT(message("{\"a\": 1}", kChannels), HasSubstr("no array of objects"));
  EXPECT_THAT(message("{\"a\": [{\"x\": 1}], \"b\": [{\"x\": 1}]}", kChannels), HasSubstr("rows = \"a\""));
  EXPECT_THAT(message(kLog, kChannels + "[recording]\nrows = \"entries\"\n"), HasSubstr("it has log"));
  EXPECT_THAT(message("[{\"time\": 0}]", kChannels), HasSubstr("no channel on; it has time"));
  EXPECT_THAT(message("[{\"time\": 0, \"angle\": 0, \"on\": 1, \"duty\": -4, \"supply\": 7}]", kChannels),
              HasSubstr("no unsigned 16 bit number"));
  EXPECT_THAT(message(kLog, kChannels + "[recording]\nresample_hz = 100\n[rig]\nsample_rate_hz = 200\n"),
              HasSubstr("leave sample_rate_hz out"));
  EXPECT_THAT(message(kLog, kChannels + "[recording]\ncell_columns = [1]\n"), HasSubstr("go together"));
  EXPECT_THAT(message(kLog, "[channels]\ny_m = \"angle\"\nu_V = { channel = \"duty\", signed_bits = 1 }\n"),
              HasSubstr("signed_bits"));
}

TEST_F(ImportJson, RowsThatLackAKeyHaveAnEmptyCell) {
  const auto table = read_json_rows(file("a.json", R"([{"a": 1}, {"a": 2, "b": 3}])"), "");
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_EQ(table->names, (std::vector<std::string>{"a", "b"}));
  EXPECT_TRUE(std::isnan(table->columns[1][0]));
  EXPECT_EQ(table->columns[1][1], 3);
}

}  // namespace
}  // namespace cartwright
