#include "docent/pictures/jpeg/raw_pixels.h"

#include <gtest/gtest.h>

namespace docent::pictures {
namespace {

RawPixels two_by_one(const std::string& encoding, const std::vector<std::uint8_t>& rows) {
  return {2, 1, rows.size(), encoding, false, rows};
}

TEST(RawPixels, LieAsTheEncodingSays) {
  const std::vector<std::uint8_t> three{1, 2, 3, 4, 5, 6}, four{1, 2, 3, 9, 4, 5, 6, 9};
  EXPECT_EQ(image_of(two_by_one("rgb8", three))->at(1, 0), (Color{4, 5, 6, 255}));
  EXPECT_EQ(image_of(two_by_one("bgr8", three))->at(1, 0), (Color{6, 5, 4, 255}));
  EXPECT_EQ(image_of(two_by_one("rgba8", four))->at(1, 0), (Color{4, 5, 6, 255})) << "what lies behind is not seen";
  EXPECT_EQ(image_of(two_by_one("bgra8", four))->at(0, 0), (Color{3, 2, 1, 255}));
  EXPECT_EQ(image_of(two_by_one("mono8", {7, 8}))->at(1, 0), (Color{8, 8, 8, 255}));
  RawPixels wide = two_by_one("mono16", three);
  const std::vector<std::uint8_t> words{0x34, 0x12, 0x78, 0x56};
  wide.rows = words;
  wide.step = 4;
  EXPECT_EQ(image_of(wide)->at(1, 0), (Color{0x56, 0x56, 0x56, 255}));
  wide.is_bigendian = true;
  EXPECT_EQ(image_of(wide)->at(1, 0), (Color{0x78, 0x78, 0x78, 255}));
}

TEST(RawPixels, OfYuvShareTheirColour) {
  const std::vector<std::uint8_t> white_black{128, 235, 128, 16};
  EXPECT_EQ(image_of(two_by_one("uyvy", white_black))->at(0, 0), (Color{255, 255, 255, 255}));
  EXPECT_EQ(image_of(two_by_one("yuv422", white_black))->at(1, 0), (Color{0, 0, 0, 255}));
  const std::vector<std::uint8_t> red{81, 90, 81, 240};
  const Color pixel = image_of(two_by_one("yuyv", red))->at(1, 0);
  EXPECT_GT(pixel.red, 250);
  EXPECT_LT(pixel.green, 5);
  EXPECT_LT(pixel.blue, 5);
}

TEST(RawPixels, RowsMayBePadded) {
  const std::vector<std::uint8_t> rows{1, 0, 0, 0, 2, 0, 0, 0};
  const RawPixels pixels{1, 2, 4, "mono8", false, rows};
  EXPECT_EQ(image_of(pixels)->at(0, 1), (Color{2, 2, 2, 255}));
}

TEST(RawPixels, ThatAreNoneAreErrors) {
  const std::vector<std::uint8_t> rows(16);
  EXPECT_EQ(image_of({2, 2, 8, "32FC1", false, rows}).error().message, "pixels of encoding '32FC1' are not read");
  EXPECT_FALSE(image_of({2, 2, 5, "rgb8", false, rows}).has_value());
  EXPECT_FALSE(image_of({2, 3, 6, "rgb8", false, rows}).has_value());
  EXPECT_FALSE(image_of({0, 2, 6, "rgb8", false, rows}).has_value());
  EXPECT_FALSE(image_of({5000, 1, 16, "mono8", false, rows}).has_value());
  EXPECT_FALSE(image_of({3, 1, 6, "yuyv", false, rows}).has_value()) << "half a pair";
}

}  // namespace
}  // namespace docent::pictures
