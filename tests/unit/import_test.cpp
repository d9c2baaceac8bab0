#include "host/session/import.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>

#include <unistd.h>
#include <cmath>
#include <memory>

#include "host/session/files.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A directory that goes with the test.
class ImportTest : public testing::Test {
 protected:
  ImportTest()
      : directory_(fs::temp_directory_path() /
                   ("cartwright-import-" + std::to_string(getpid()) +
                    testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(directory_);
    for (int row = 0; row < kRows; ++row) {
      t_s_.push_back(1e-3 * row);
      y_m_.push_back(0.05 * std::sin(0.01 * row));
      u_V_.push_back(row % 50 < 25 ? 2.5 : -2.5);
    }
  }
  ~ImportTest() override { fs::remove_all(directory_); }

  Result<ImportMap> map(const std::string& text) {
    const fs::path file = directory_ / "map.toml";
    EXPECT_TRUE(write_file(file, text));
    return read_import_map(file);
  }

  /// Vectors "t", "q" (millimetres), "v" and a 3 x N matrix "data", a structure "run" with field "q", a cell
  /// "cells", and cells "runs" of two rows and three columns: the time; position, position, voltage.
  fs::path mat(mat_ft version) {
    const fs::path file = directory_ / "recording.mat";
    mat_t* out = Mat_CreateVer(file.c_str(), nullptr, version);
    std::vector<double> q_mm, data;
    for (std::size_t row = 0; row < t_s_.size(); ++row) {
      q_mm.push_back(1e3 * y_m_[row]);
      data.insert(data.end(), {t_s_[row], y_m_[row], u_V_[row]});
    }
    const auto variable = [](const char* name, std::size_t rows, std::size_t columns,
                             std::vector<double>& values) {
      std::size_t size[2] = {rows, columns};
      return Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, values.data(), 0);
    };
    const auto keep = [out](matvar_t* made) {
      Mat_VarWrite(out, made, MAT_COMPRESSION_NONE);
      Mat_VarFree(made);
    };
    keep(variable("t", kRows, 1, t_s_));
    keep(variable("q", 1, kRows, q_mm));
    keep(variable("v", kRows, 1, u_V_));
    keep(variable("data", 3, kRows, data));
    std::size_t one[2] = {1, 1};
    const char* fields[] = {"q"};
    matvar_t* run = Mat_VarCreateStruct("run", 2, one, fields, 1);
    Mat_VarSetStructFieldByName(run, "q", 0, variable("q", 1, kRows, q_mm));
    keep(run);
    std::size_t two[2] = {1, 2};
    matvar_t* cells = Mat_VarCreate("cells", MAT_C_CELL, MAT_T_CELL, 2, two, nullptr, 0);
    Mat_VarSetCell(cells, 0, variable(nullptr, kRows, 1, t_s_));
    Mat_VarSetCell(cells, 1, variable(nullptr, kRows, 1, u_V_));
    keep(cells);
    std::size_t runs_size[2] = {2, 3};
    matvar_t* runs = Mat_VarCreate("runs", MAT_C_CELL, MAT_T_CELL, 2, runs_size, nullptr, 0);
    for (int n = 0; n < 3; ++n) {
      Mat_VarSetCell(runs, 2 * n, variable(nullptr, kRows, 1, t_s_));
      Mat_VarSetCell(runs, 2 * n + 1, variable(nullptr, kRows, 1, n == 2 ? u_V_ : y_m_));
    }
    keep(runs);
    Mat_Close(out);
    return file;
  }

  static constexpr int kRows = 400;
  fs::path directory_;
  std::vector<double> t_s_, y_m_, u_V_;
};

TEST_F(ImportTest, BothMatlabFormatsGiveTheSameNumbers) {
  const auto channels =
      map("[channels]\nt_s = \"t\"\ny_m = { channel = \"q\", scale = 1e-3 }\nu_V = { channel = \"v\", scale "
          "= -2, offset = 1 }\n");
  ASSERT_TRUE(channels) << channels.error().message;
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const auto recording = import_recording(mat(version), *channels);
    ASSERT_TRUE(recording) << recording.error().message;
    ASSERT_EQ(recording->size(), t_s_.size());
    EXPECT_EQ(recording->file, "recording.csv");
    EXPECT_EQ(recording->t_s, t_s_);
    for (std::size_t row = 0; row < t_s_.size(); ++row) {
      EXPECT_NEAR(recording->y_m[row], y_m_[row], 1e-15);
      EXPECT_DOUBLE_EQ(recording->u_V[row], 1 - 2 * u_V_[row]);
    }
  }
}

TEST_F(ImportTest, RowsCellsAndFieldsArePicked) {
  const auto channels =
      map("[channels]\nt_s = { channel = \"cells\", cell = [1, 1] }\ny_m = { channel = \"run.q\", scale = "
          "0.001 }\n"
          "u_V = { channel = \"data\", row = 3 }\n");
  ASSERT_TRUE(channels) << channels.error().message;
  const auto recording = import_recording(mat(MAT_FT_MAT5), *channels);
  ASSERT_TRUE(recording) << recording.error().message;
  EXPECT_EQ(recording->t_s, t_s_);
  EXPECT_EQ(recording->u_V, u_V_);
}

TEST_F(ImportTest, EveryColumnOfCellsBecomesARecording) {
  const auto channels = map(
      "[channels]\nt_s = { channel = \"runs\", cell_row = 1 }\ny_m = { channel = \"runs\", cell_row = 2 }\n"
      "u_V = { channel = \"runs\", cell_row = 2, scale = 2 }\n[recording]\ncell_columns = [1, 3]\n");
  ASSERT_TRUE(channels) << channels.error().message;
  const std::vector<fs::path> files{mat(MAT_FT_MAT5)};
  const auto session = import_session(files, *channels);
  ASSERT_TRUE(session) << session.error().message;
  ASSERT_EQ(session->recordings.size(), 2u);
  EXPECT_EQ(session->recordings[0].file, "recording_1.csv");
  EXPECT_EQ(session->recordings[1].file, "recording_3.csv");
  EXPECT_EQ(session->recordings[0].y_m, y_m_);
  EXPECT_EQ(session->recordings[1].y_m, u_V_);
  const auto all = import_recording(files[0], *channels, 4);
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().message, HasSubstr("no cell [1, 4]"));
}

TEST_F(ImportTest, WhatIsNotThereIsNamed) {
  const fs::path file = mat(MAT_FT_MAT5);
  const auto message = [&](const std::string& y_m) {
    const auto channels = map("[channels]\nt_s = \"t\"\nu_V = \"v\"\ny_m = " + y_m + "\n");
    if (!channels) return channels.error().message;
    const auto recording = import_recording(file, *channels);
    return recording ? std::string("accepted") : recording.error().message;
  };
  EXPECT_THAT(message("\"angle\""), HasSubstr("no variable angle; it holds t, q, v, data"));
  EXPECT_THAT(message("\"data\""), HasSubstr("choose with row = N or column = N"));
  EXPECT_THAT(message("{ channel = \"data\", row = 4 }"), HasSubstr("rows 1 to 3"));
  EXPECT_THAT(message("\"cells\""), HasSubstr("choose with cell = [row, column]"));
  EXPECT_THAT(message("{ channel = \"q\", factor = 2 }"), HasSubstr("factor"));
  EXPECT_THAT(message("{ channel = \"q\", scale = 0 }"), HasSubstr("scale = 0"));
  EXPECT_THAT(message("7"), HasSubstr("y_m must be"));
}

TEST_F(ImportTest, WrongUnitsAreRefused) {
  const fs::path file = mat(MAT_FT_MAT5);
  const auto message = [&](const std::string& text) {
    const auto channels = map(text);
    if (!channels) return channels.error().message;
    const auto recording = import_recording(file, *channels);
    return recording ? std::string("accepted") : recording.error().message;
  };
  const std::string good = "[channels]\nt_s = \"t\"\nu_V = \"v\"\ny_m = { channel = \"q\", scale = 1e-3 }\n";
  EXPECT_EQ(message(good + "[rig]\nsample_rate_hz = 1000\ntravel_m = [-0.4, 0.4]\nvoltage_limit_V = 12\n"),
            "accepted");
  EXPECT_THAT(message("[channels]\nt_s = \"t\"\nu_V = \"v\"\ny_m = \"q\"\n"), HasSubstr("check its scale"));
  EXPECT_THAT(message("[channels]\nt_s = \"t\"\nu_V = \"v\"\ny_m = { channel = \"q\", scale = 0.05 }\n[rig]\n"
                      "travel_m = [-0.4, 0.4]\n"),
              HasSubstr("y_m"));
  EXPECT_THAT(message("[channels]\nt_s = { channel = \"t\", scale = 1e3 }\nu_V = \"v\"\ny_m = \"q\"\n"),
              HasSubstr("milliseconds"));
  EXPECT_THAT(message(good + "[rig]\nsample_rate_hz = 500\n"), HasSubstr("implies 1000 Hz"));
  EXPECT_THAT(message(good + "[rig]\nvoltage_limit_V = 0.5\n"), HasSubstr("u_V"));
  EXPECT_THAT(message(good + "[rig]\nencoder_resolution_um = 5\n"),
              HasSubstr("unknown key encoder_resolution_um"));
  EXPECT_THAT(message("[channels]\nu_V = \"v\"\ny_m = \"q\"\n"), HasSubstr("one must give the time"));
  EXPECT_THAT(message("[channels]\nt_s = \"t\"\ny_m = \"q\"\n"), HasSubstr("no u_V"));
  EXPECT_THAT(message(good + "[controller]\ntype = \"pd\"\nkp_V_per_m = 60\n"), HasSubstr("r_m"));
}

TEST_F(ImportTest, CsvFilesBecomeOneSessionThatReadsBack) {
  std::string text = "\"V1\",\"V2\",\n";
  for (std::size_t row = 0; row < t_s_.size(); ++row) {
    text += std::to_string(u_V_[row]) + "," + std::to_string(1e3 * y_m_[row]) + ",\n";
  }
  const std::vector<fs::path> files{directory_ / "a.csv", directory_ / "b.csv"};
  for (const fs::path& file : files) ASSERT_TRUE(write_file(file, text));
  const auto channels = map(
      "[channels]\ny_m = { channel = \"V2\", scale = 1e-3 }\nu_V = \"V1\"\n[rig]\nsample_rate_hz = 610\n");
  ASSERT_TRUE(channels) << channels.error().message;
  const auto session = import_session(files, *channels);
  ASSERT_TRUE(session) << session.error().message;
  ASSERT_TRUE(write_session(*session, directory_ / "session"));
  const auto back = read_session(directory_ / "session");
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->recordings.size(), 2u);
  EXPECT_EQ(back->recordings[1].y_m, session->recordings[1].y_m);
  EXPECT_EQ(back->recordings[1].t_s[61], 61 / 610.0);
  EXPECT_EQ(back->rig.sample_rate_hz, 610);
  EXPECT_EQ(back->rig.voltage_limit_V, 2.5);
  EXPECT_FALSE(back->recordings[0].has_controller());
}

TEST_F(ImportTest, ABrokenMatlabFileIsRefused) {
  const fs::path file = directory_ / "broken.mat";
  ASSERT_TRUE(write_file(file, "this is no MATLAB file"));
  const auto opened = MatFile::open(file);
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, HasSubstr("not a readable MATLAB file"));
  ASSERT_TRUE(write_file(file, ""));
  const auto empty = MatFile::open(file);
  ASSERT_FALSE(empty);
  EXPECT_THAT(empty.error().message, HasSubstr("holds no variables"));
  const auto absent = MatFile::open(directory_ / "absent.mat");
  ASSERT_FALSE(absent);
  EXPECT_THAT(absent.error().message, HasSubstr("No such file"));
}

}  // namespace
}  // namespace cartwright
