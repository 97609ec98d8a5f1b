#include "docent/pictures/jpeg/jpeg.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace docent::pictures {
namespace {

Image checkered() {
  Image image{64, 48};
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      image.set(x, y, (x / 16 + y / 16) % 2 == 0 ? colors::kBlue : colors::kOrange);
  return image;
}

TEST(Jpeg, ComesBackNearlyAsItWent) {
  const Image image = checkered();
  const auto file = encode_jpeg(image, 90);
  const auto size = jpeg_size(file);
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 64);
  EXPECT_EQ(size->height, 48);
  const auto back = decode_jpeg(file);
  ASSERT_TRUE(back);
  for (const auto& [x, y] : {std::pair{8, 8}, std::pair{24, 8}, std::pair{56, 40}}) {
    EXPECT_NEAR(back->at(x, y).red, image.at(x, y).red, 12);
    EXPECT_NEAR(back->at(x, y).green, image.at(x, y).green, 12);
    EXPECT_NEAR(back->at(x, y).blue, image.at(x, y).blue, 12);
  }
}

TEST(Jpeg, LessQualityIsASmallerFile) {
  EXPECT_LT(encode_jpeg(checkered(), 30).size(), encode_jpeg(checkered(), 95).size());
}

TEST(Jpeg, RefusesWhatIsNone) {
  auto file = encode_jpeg(checkered(), 80);
  EXPECT_FALSE(decode_jpeg(file, 63));  // larger than the caller wants
  EXPECT_FALSE(decode_jpeg(std::span{file}.first(file.size() / 2)));
  EXPECT_FALSE(decode_jpeg({}));
  EXPECT_FALSE(jpeg_size({}));
  const std::vector<std::uint8_t> text{'<', 's', 'c', 'r', 'i', 'p', 't', '>'};
  EXPECT_FALSE(jpeg_size(text));
}

}  // namespace
}  // namespace docent::pictures
