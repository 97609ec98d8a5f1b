#include "docent/base/files.h"

#include <gtest/gtest.h>
#include <zlib.h>

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
