#include "docent/base/files.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <array>

namespace docent {
namespace {

class Files : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_ = std::filesystem::path{::testing::TempDir()} / "docent_files_test";
};

TEST_F(Files, WhatIsWrittenIsRead) {
  ASSERT_TRUE(write_file_atomically(folder_ / "a", "first").has_value());
  ASSERT_TRUE(write_file_atomically(folder_ / "a", "second").has_value());
  EXPECT_EQ(read_file(folder_ / "a").value(), "second");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder_}, {}), 1) << "something was left beside the file";
}

TEST_F(Files, ALinkStaysAndItsFileIsReplaced) {
  std::filesystem::create_directories(folder_ / "far");
  std::filesystem::create_symlink("far/file", folder_ / "link");
  for (const char* content : {"made", "replaced"}) {
    ASSERT_TRUE(write_file_atomically(folder_ / "link", content).has_value());
    EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link"));
    EXPECT_EQ(read_file(folder_ / "far" / "file").value(), content);
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder_ / "far"}, {}), 1);
}

TEST_F(Files, APipeIsWrittenIntoAndStays) {
  const auto pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(reader, 0);
  ASSERT_TRUE(write_file_atomically(pipe, "through").has_value());
  std::array<char, 20> got{};
  EXPECT_EQ(::read(reader, got.data(), got.size()), 7);
  EXPECT_STREQ(got.data(), "through");
  ::close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator{folder_}, {}), 1);
}

TEST_F(Files, FaultsNameTheFile) {
  EXPECT_NE(read_file(folder_ / "none").error().message.find("none: cannot be read"), std::string::npos);
  EXPECT_NE(read_file(folder_).error().message.find("directory"), std::string::npos);
  EXPECT_NE(write_file_atomically(folder_ / "no" / "where", "x").error().message.find("cannot be written"),
            std::string::npos);
}

TEST_F(Files, GzipIsUnpackedAndPlainIsLeft) {
  const auto packed = folder_ / "packed.gz";
  const gzFile file = gzopen(packed.c_str(), "wb");
  const std::string text(100000, 'x');
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  EXPECT_EQ(read_maybe_gzipped(packed).value(), text);
  const std::string bytes = read_file(packed).value();
  ASSERT_TRUE(write_file_atomically(folder_ / "cut.gz", bytes.substr(0, bytes.size() / 2)).has_value());
  EXPECT_FALSE(read_maybe_gzipped(folder_ / "cut.gz").has_value());
  ASSERT_TRUE(write_file_atomically(folder_ / "plain", "plain").has_value());
  EXPECT_EQ(read_maybe_gzipped(folder_ / "plain").value(), "plain");
  EXPECT_FALSE(read_maybe_gzipped(packed, 10).has_value());
}

}  // namespace
}  // namespace docent
