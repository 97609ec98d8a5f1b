#include "fuzz_replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>

namespace docent {
namespace {

class FuzzReplayed : public ::testing::Test {
 protected:
  FuzzReplayed() : folder_{std::filesystem::temp_directory_path() / ("docent-replay-" + std::to_string(::getpid()))} {
    std::filesystem::create_directories(folder_ / "inner");
    write("b", "xyz");
    write("a", "The quick brown fox jumps over the lazy dog");
  }
  ~FuzzReplayed() override { std::filesystem::remove_all(folder_); }
  FuzzReplayed(const FuzzReplayed&) = delete;
  FuzzReplayed& operator=(const FuzzReplayed&) = delete;
  void write(const std::string& name, const std::string& text) { std::ofstream{folder_ / name} << text; }
  std::filesystem::path folder_;
};

int abort_at_x(const std::uint8_t* data, std::size_t size) {
  if (size > 0 && data[0] == 'x') std::abort();
  return 0;
}
int hang_at_x(const std::uint8_t* data, std::size_t size) {
  while (size > 0 && data[0] == 'x') ::usleep(1000);
  return 0;
}
int leave_at_x(const std::uint8_t* data, std::size_t size) {
  if (size > 0 && data[0] == 'x') std::exit(3);
  return 0;
}
int take(const std::uint8_t* /*data*/, std::size_t /*size*/) { return 0; }

TEST_F(FuzzReplayed, AFolderStandsForItsFilesAndTheEmptyInputComesFirst) {
  const auto inputs = fuzz_inputs({folder_, folder_ / "b"}, 0);
  ASSERT_EQ(inputs.size(), 4U);
  EXPECT_TRUE(inputs[0].bytes.empty());
  EXPECT_EQ(inputs[1].bytes.size(), 43U);
  EXPECT_EQ(inputs[2].bytes, (std::vector<std::uint8_t>{'x', 'y', 'z'}));
  EXPECT_EQ(inputs[3].bytes, inputs[2].bytes);
}

TEST_F(FuzzReplayed, SpoiledOnesDifferAndAreTheSameAgain) {
  const auto inputs = fuzz_inputs({folder_ / "a"}, 200);
  const auto again = fuzz_inputs({folder_ / "a"}, 200);
  ASSERT_EQ(inputs.size(), 202U);
  std::set<std::vector<std::uint8_t>> different;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    EXPECT_EQ(inputs[i].bytes, again[i].bytes);
    different.insert(inputs[i].bytes);
    EXPECT_LE(inputs[i].bytes.size(), 43U + 4U * 16U);
  }
  EXPECT_GT(different.size(), 180U);
}

TEST_F(FuzzReplayed, WhatEndsAFuzzerIsNamedWithItsInput) {
  const auto inputs = fuzz_inputs({folder_}, 0);
  const FuzzReplay good = replay({"good", take}, inputs, std::chrono::seconds{60});
  EXPECT_EQ(good.inputs, 3U);
  EXPECT_EQ(good.fault, "");
  const FuzzReplay aborted = replay({"aborts", abort_at_x}, inputs, std::chrono::seconds{60});
  EXPECT_EQ(aborted.fault, "Aborted at " + folder_.filename().string() + "/b");
  EXPECT_EQ(aborted.broke_at.bytes, inputs[2].bytes);
  EXPECT_EQ(replay({"hangs", hang_at_x}, inputs, std::chrono::seconds{1}).fault,
            "not done after 1 s at " + folder_.filename().string() + "/b");
  EXPECT_EQ(replay({"leaves", leave_at_x}, inputs, std::chrono::seconds{60}).fault,
            "exit code 3 at " + folder_.filename().string() + "/b");
}

}  // namespace
}  // namespace docent
