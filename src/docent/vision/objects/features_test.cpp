#include "docent/vision/objects/features.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::vision {
namespace {

namespace features_test {

/// A box of `color` in the middle of a sheet, all of it under a lamp of this strength.
pictures::Image box(pictures::Color color, double lamp, int width = 60, int height = 32) {
  const auto lit = [&](pictures::Color of) {
    const auto dim = [&](std::uint8_t value) { return static_cast<std::uint8_t>(std::lround(lamp * value)); };
    return pictures::Color{dim(of.red), dim(of.green), dim(of.blue), 255};
  };
  pictures::Image picture{160, 120, lit({230, 228, 225, 255})};
  for (int y = 60 - height / 2; y < 60 + height / 2; ++y)
    for (int x = 80 - width / 2; x < 80 + width / 2; ++x) picture.set(x, y, lit(color));
  return picture;
}

Features features_of_picture(const pictures::Image& picture) {
  const Sites sites = sites_of(picture, 2);
  return features_of(sites, part_from_ground(sites, merge_regions(sites)));
}

std::size_t named(const std::string& name) {
  for (std::size_t i = 0; i < kFeatures; ++i)
    if (feature_names()[i] == name) return i;
  ADD_FAILURE() << name;
  return 0;
}

TEST(Features, TellColourAndSizeOfTheThingAlone) {
  const Features red = features_of_picture(box({180, 60, 50, 255}, 1.0));
  const Features blue = features_of_picture(box({50, 60, 180, 255}, 1.0));
  EXPECT_NEAR(red[named("red_green_mean")], 118.0, 2.0);
  EXPECT_LT(blue[named("yellow_blue_mean")], -100.0);
  EXPECT_NEAR(std::exp(red[named("size")]), 60.0 * 32.0 / (160.0 * 120.0), 0.01);
  EXPECT_NEAR(std::exp(red[named("elongation")]), 60.0 / 32.0, 0.2);
}

TEST(Features, LuminanceIsThatOfTheGroundsShareWhateverTheLamp) {
  const Features bright = features_of_picture(box({110, 112, 115, 255}, 1.0));
  const Features dim = features_of_picture(box({110, 112, 115, 255}, 0.7));
  EXPECT_NEAR(bright[named("luminance_mean")], dim[named("luminance_mean")], 0.02);
  EXPECT_NEAR(bright[named("luminance_mean")], 112.0 / 228.0, 0.02);
}

TEST(Features, AThingThatFillsThePictureIsAllOfIt) {
  const pictures::Image cardboard{160, 120, {170, 120, 70, 255}};
  const Sites sites = sites_of(cardboard, 4);
  const StandingThing thing = part_from_ground(sites, merge_regions(sites));
  EXPECT_EQ(thing.ground_sites, 0U);
  EXPECT_EQ(thing.sites, sites.cells.size());
  for (const double feature : features_of(sites, thing)) EXPECT_TRUE(std::isfinite(feature));
}

TEST(Features, AnEmptySheetIsAThingAsPaleAsItsGround) {
  const pictures::Image sheet{160, 120, {230, 228, 225, 255}};
  const Sites sites = sites_of(sheet, 4);
  EXPECT_EQ(part_from_ground(sites, merge_regions(sites)).sites, sites.cells.size());
}

}  // namespace features_test
}  // namespace
}  // namespace docent::vision
