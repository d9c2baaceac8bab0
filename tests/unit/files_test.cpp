#include "host/session/files.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/small_disk.hpp"

namespace cartwright {
namespace {

namespace fs = std::filesystem;

class Files : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(directory_); }
  void TearDown() override { fs::remove_all(directory_); }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(directory_), fs::directory_iterator{}));
  }
  const fs::path directory_ =
      fs::temp_directory_path() / ("cartwright_files_" + std::to_string(::getpid()) +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
};

const std::vector<NamedText> kTwo = {{"small", "text"}, {"large", std::string(100000, 'x')}};

TEST_F(Files, AreAllWritten) {
  ASSERT_TRUE(write_files(directory_ / "a" / "b", kTwo));
  EXPECT_EQ(read_file(directory_ / "a/b/small").value(), "text");
  EXPECT_EQ(read_file(directory_ / "a/b/large").value().size(), 100000u);
}

TEST_F(Files, LeaveNothingBehindOnAFullDisk) {
  {
    const test::SmallDisk full(5000);
    EXPECT_FALSE(write_files(directory_ / "a" / "b", kTwo));
    EXPECT_FALSE(write_file(directory_ / "alone", kTwo[1].text));
  }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(Files, KeepWhatWasThereOnAFullDisk) {
  ASSERT_TRUE(write_files(directory_, {{"small", "before"}, {"large", "before"}}));
  {
    const test::SmallDisk full(5000);
    EXPECT_FALSE(write_files(directory_, kTwo));
  }
  EXPECT_EQ(read_file(directory_ / "small").value(), "before");
  EXPECT_EQ(read_file(directory_ / "large").value(), "before");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(Files, SayWhyTheyCannotBeWritten) {
  ASSERT_TRUE(write_file(directory_ / "file", "text"));
  const auto written = write_files(directory_ / "file" / "in_it", kTwo);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("Not a directory"), std::string::npos) << written.error().message;
}

TEST_F(Files, ReplaceWhatALinkLeadsTo) {
  ASSERT_TRUE(write_file(directory_ / "file", "before"));
  fs::create_symlink("file", directory_ / "link");
  ASSERT_TRUE(write_file(directory_ / "link", "after"));
  EXPECT_TRUE(fs::is_symlink(directory_ / "link"));
  EXPECT_EQ(read_file(directory_ / "file").value(), "after");
}

TEST_F(Files, LeaveDevicesAndPipesWhatTheyAre) {
  const fs::path pipe = directory_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  EXPECT_TRUE(write_file(pipe, "text"));
  std::string got(8, '\0');
  EXPECT_EQ(::read(reader, got.data(), got.size()), 4);
  ::close(reader);
  EXPECT_TRUE(fs::is_fifo(pipe));
  const auto among_others = write_files(directory_, {{"small", "text"}, {"pipe", "text"}});
  ASSERT_FALSE(among_others);
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, RefuseADirectoryBeforeAnythingIsWritten) {
  fs::create_directory(directory_ / "large");
  const auto written = write_files(directory_, kTwo);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("Is a directory"), std::string::npos) << written.error().message;
  EXPECT_EQ(entries(), 1u);
}

}  // namespace
}  // namespace cartwright
