#include "docent/telepresence/uplink/envelope/picture_pieces.h"

#include <gtest/gtest.h>

namespace docent::telepresence {
namespace {

TEST(Pieces, BecomeThePictureAgain) {
  const auto picture = std::make_shared<const std::string>(std::string(2500, 'x') + "end");
  PictureCutter cutter;
  EXPECT_FALSE(cutter.next(1000));
  cutter.begin("/a.jpg", "1.5", picture);
  PictureJoiner joiner;
  std::optional<JoinedPicture> joined;
  int pieces = 0;
  while (auto piece = cutter.next(1000)) {
    EXPECT_FALSE(joined);
    joined = joiner.add(std::move(*piece));
    ++pieces;
  }
  EXPECT_EQ(pieces, 3);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->bytes, *picture);
  EXPECT_EQ(joined->taken, "1.5");
}

TEST(Pieces, OfWhichOneIsMissingBecomeNothing) {
  PictureJoiner joiner;
  EXPECT_FALSE(joiner.add({"/a.jpg", "1", 9, 0, "abc"}));
  EXPECT_FALSE(joiner.add({"/a.jpg", "1", 9, 6, "ghi"}));
  EXPECT_FALSE(joiner.add({"/a.jpg", "1", 9, 3, "def"}));
  // The next picture begins anew, also in the middle of another one.
  EXPECT_FALSE(joiner.add({"/a.jpg", "2", 4, 0, "ab"}));
  EXPECT_FALSE(joiner.add({"/b.jpg", "3", 4, 0, "AB"}));
  EXPECT_EQ(joiner.add({"/b.jpg", "3", 4, 2, "CD"})->bytes, "ABCD");
  EXPECT_EQ(joiner.add({"/a.jpg", "2", 4, 2, "cd"})->bytes, "abcd");
}

}  // namespace
}  // namespace docent::telepresence
