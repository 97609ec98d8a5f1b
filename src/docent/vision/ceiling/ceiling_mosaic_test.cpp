#include "docent/vision/ceiling/ceiling_mosaic.h"

#include <gtest/gtest.h>

#include "docent/vision/ceiling/mosaic_drawing.h"
#include "docent/vision/ceiling/testing.h"

namespace docent::vision::ceiling_mosaic_test {
namespace {

using ceiling_testing::camera;
using ceiling_testing::Hall;

TEST(MosaicLevel, SlopesAreThoseOfFiniteDifferences) {
  CeilingMosaic mosaic{{40, 30, 0.1, {1.0, 2.0}}, {3.0}, std::vector<std::uint8_t>(1200), std::vector<float>(1200)};
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column)
      mosaic.brightness[mosaic.frame.index({column, row})] =
          0.01F * static_cast<float>(column) + 0.02F * static_cast<float>(row);
  const MosaicLevel level{mosaic, 0.0};
  MosaicLevel::Look look;
  ASSERT_TRUE(level.look({2.55, 3.55}, 0, look));  // the centre of cell (15, 15)
  EXPECT_NEAR(look.brightness, 0.45F, 1e-6F);
  EXPECT_NEAR(look.by_x, 0.1F, 1e-5F);
  EXPECT_NEAR(look.by_y, 0.2F, 1e-5F);
  EXPECT_FALSE(level.look({0.9, 3.0}, 0, look));
  EXPECT_FALSE(level.look({2.55, 3.55}, 1, look));
}

TEST(MosaicLevel, PartsDoNotRunIntoOneAnother) {
  CeilingMosaic mosaic{{40, 10, 0.1, {}}, {3.0, 6.0}, std::vector<std::uint8_t>(400), std::vector<float>(400)};
  for (int row = 0; row < 10; ++row)
    for (int column = 20; column < 40; ++column) {
      mosaic.part[mosaic.frame.index({column, row})] = 1;
      mosaic.brightness[mosaic.frame.index({column, row})] = 1.0F;
    }
  const MosaicLevel level{mosaic, 0.2};
  MosaicLevel::Look look;
  ASSERT_TRUE(level.look({1.85, 0.5}, 0, look));
  EXPECT_NEAR(look.brightness, 0.0F, 1e-3F);
  ASSERT_TRUE(level.look({2.15, 0.5}, 1, look));
  EXPECT_NEAR(look.brightness, 1.0F, 1e-3F);
  EXPECT_FALSE(level.look({2.0, 0.5}, 0, look));
}

TEST(MosaicDrawing, IsTheCeiling) {
  const Hall hall{.seed = 6};
  const CeilingCamera eye = camera();
  CeilingMosaic parts{{500, 400, 0.02, {}}, {hall.low, hall.high}, std::vector<std::uint8_t>(200000), {}};
  for (std::size_t i = 0; i < parts.part.size(); ++i)
    parts.part[i] = hall.is_high(parts.frame.centre({static_cast<int>(i % 500), static_cast<int>(i / 500)})) ? 1 : 0;
  MosaicDrawing drawing{parts, eye, 1.2};
  Rng rng{1};
  for (int i = 0; i < 12; ++i) {
    const Pose2 at{2.0 + 0.5 * i, 3.0 + 0.3 * (i % 4), Angle::degrees(40.0 * i)};
    const auto picture = hall.picture(eye, at, {.gain = 0.8, .offset = 0.05, .noise = 0.02}, rng);
    drawing.add({picture.view(), at, 0.8, 0.05});
  }
  const CeilingMosaic mosaic = drawing.mosaic();
  double squares = 0.0;
  int known = 0;
  for (std::size_t i = 0; i < mosaic.part.size(); ++i) {
    if (mosaic.part[i] == CeilingMosaic::kUnknown) continue;
    const Point2 at = mosaic.frame.centre({static_cast<int>(i % 500), static_cast<int>(i / 500)});
    const double off = static_cast<double>(mosaic.brightness[i]) - hall.brightness(at);
    squares += off * off;
    ++known;
  }
  EXPECT_GT(known, 60000);
  EXPECT_LT(std::sqrt(squares / known), 0.04);
}

TEST(MosaicOfLamps, HasThemOnTheirGrid) {
  const CeilingMosaic mosaic = mosaic_of({3.0, 4.0, 0.4, 1.2, 2.5}, {400, 400, 0.05, {-10.0, -10.0}});
  const auto at = [&](Point2 place) { return mosaic.brightness[mosaic.frame.index(mosaic.frame.cell_at(place))]; };
  EXPECT_EQ(at({0.01, 0.01}), 1.0F);
  EXPECT_EQ(at({3.01, -3.99}), 1.0F);
  EXPECT_EQ(at({0.3, 0.0}), 0.0F);
  EXPECT_EQ(at({0.01, 0.51}), 1.0F);
  EXPECT_EQ(at({0.01, 0.71}), 0.0F);
}

TEST(LookingUp, HasTheTopOfThePictureAhead) {
  const CeilingCamera eye{camera().lens, looking_up({0.0, 0.0, 1.0})};
  const auto ahead = eye.pixel_of({0.5, 0.0}, 3.0), left = eye.pixel_of({0.0, 0.5}, 3.0);
  ASSERT_TRUE(ahead && left);
  EXPECT_LT(ahead->y(), 85.0);
  EXPECT_NEAR(ahead->x(), 119.5, 1e-9);
  EXPECT_GT(left->x(), 125.0);
  // Its Jacobian.
  Eigen::Matrix<double, 2, 3> by_robot;
  const auto at = eye.pixel_of({0.4, -0.3}, 3.0, &by_robot);
  ASSERT_TRUE(at);
  EXPECT_LT(((*eye.pixel_of({0.4 + 1e-6, -0.3}, 3.0) - *at) / 1e-6 - by_robot.col(0)).norm(), 1e-2);
  EXPECT_LT(((*eye.pixel_of({0.4, -0.3}, 3.0 + 1e-6) - *at) / 1e-6 - by_robot.col(2)).norm(), 1e-2);
}

}  // namespace
}  // namespace docent::vision::ceiling_mosaic_test
