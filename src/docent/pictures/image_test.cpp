#include "docent/pictures/image.h"

#include <gtest/gtest.h>

namespace docent::pictures {
namespace {

TEST(Image, BlendsByAlphaAndCoverage) {
  Image image{3, 2, colors::kWhite};
  image.blend(1, 1, colors::kBlack, 0.5);
  image.blend(2, 1, with_alpha(colors::kBlack, 51));
  image.blend(3, 1, colors::kBlack);  // outside: nothing happens
  image.blend(-1, 0, colors::kBlack);
  EXPECT_EQ(image.at(0, 0), colors::kWhite);
  EXPECT_EQ(image.at(1, 1), (Color{128, 128, 128}));
  EXPECT_EQ(image.at(2, 1), (Color{204, 204, 204}));
}

TEST(Image, BlendsOntoClearPixelsWithoutADarkRim) {
  Image image{1, 1, Color{0, 0, 0, 0}};
  image.blend(0, 0, colors::kRed, 0.25);
  EXPECT_EQ(image.at(0, 0), with_alpha(colors::kRed, 64));
}

TEST(Colors, MapsAreMonotoneInDarkness) {
  const auto light = [](Color c) { return 0.299 * c.red + 0.587 * c.green + 0.114 * c.blue; };
  for (int i = 0; i < 100; ++i) EXPECT_GT(light(heat(i / 100.0)), light(heat((i + 1) / 100.0))) << i;
  EXPECT_EQ(heat(-1.0), heat(0.0));
  EXPECT_EQ(heat(2.0), heat(1.0));
  EXPECT_EQ(distinct(0), distinct(8));
}

}  // namespace
}  // namespace docent::pictures
