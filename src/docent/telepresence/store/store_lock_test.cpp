#include "docent/telepresence/store/store_lock.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace docent::telepresence {
namespace {

using Of = StoreLock::Part;
using Held = StoreLock::Kind;

class TheLockOfAStore : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/docent-lock-XXXXXX";
    folder_ = ::mkdtemp(name);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(TheLockOfAStore, HoldsBetweenConnectionsOfOneProcess) {
  const auto one = StoreLock::open(folder_ / "db").value();
  {
    const auto other = StoreLock::open(folder_ / "db").value();
    EXPECT_TRUE(one.try_for(Of::use, Held::shared));
    EXPECT_TRUE(other.try_for(Of::use, Held::shared));
    EXPECT_FALSE(one.try_for(Of::use, Held::alone));
    EXPECT_TRUE(one.try_for(Of::commit, Held::alone)) << "another part";
    other.release(Of::use);
    EXPECT_TRUE(one.try_for(Of::use, Held::alone));
    EXPECT_FALSE(other.try_for(Of::use, Held::shared));
    one.release(Of::use);
    EXPECT_TRUE(other.try_for(Of::use, Held::alone));
  }
  EXPECT_TRUE(one.try_for(Of::use, Held::alone)) << "whoever ends releases";
}

TEST_F(TheLockOfAStore, KeepsItsNote) {
  const auto one = StoreLock::open(folder_ / "db").value();
  EXPECT_FALSE(one.note().is_open);
  StoreLock::Note note;
  note.is_open = true;
  for (std::uint64_t i = 0; i < 50; ++i) note.mended.push_back({7, i});
  note.said_at = 12;
  note.said = "open and mended 3 4: what was said";
  ASSERT_TRUE(one.write(note));
  const auto read = StoreLock::open(folder_ / "db").value().note();
  EXPECT_TRUE(read.is_open);
  EXPECT_EQ(read.said, note.said);
  EXPECT_EQ(read.said_at, 12);
  ASSERT_FALSE(read.mended.empty());
  EXPECT_LE(read.mended.size(), 20U);
  EXPECT_EQ(read.mended.back(), (FileMark{7, 49}));
  ASSERT_TRUE(one.write({}));
  EXPECT_FALSE(one.note().is_open) << "nothing of the longer one is left";
  EXPECT_TRUE(one.note().said.empty());
  EXPECT_FALSE(StoreLock::open(folder_ / "none" / "db"));
}

}  // namespace
}  // namespace docent::telepresence
