#include "docent/telepresence/server/screen_key.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace docent::telepresence {
namespace {

class ScreenKeyTest : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("docent-key-" + std::to_string(::getpid()));
  std::filesystem::path file_ = folder_ / "screen.key";
};

TEST_F(ScreenKeyTest, IsMadeOnceAndReadByItsOwnerAlone) {
  const auto key = screen_key(file_);
  ASSERT_TRUE(key) << key.error().message;
  EXPECT_EQ(key->size(), 32U);
  EXPECT_EQ(screen_key(file_).value(), *key);
  EXPECT_EQ(std::filesystem::status(file_).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  const auto other = screen_key(folder_ / "other.key");
  ASSERT_TRUE(other);
  EXPECT_NE(*other, *key);
}

TEST_F(ScreenKeyTest, WhatIsNoKeyIsReplaced) {
  for (const char* text : {"", "0000", "the key", "0123456789abcdef0123456789ABCDEF"}) {
    std::ofstream{file_} << text;
    const auto key = screen_key(file_);
    ASSERT_TRUE(key);
    EXPECT_EQ(key->size(), 32U);
    EXPECT_NE(*key, text);
    EXPECT_EQ(screen_key(file_).value(), *key);
  }
}

TEST_F(ScreenKeyTest, AFolderThatIsNotThereIsSaid) {
  const auto key = screen_key(folder_ / "nowhere/screen.key");
  ASSERT_FALSE(key);
  EXPECT_NE(key.error().message.find("nowhere"), std::string::npos);
}

}  // namespace
}  // namespace docent::telepresence
