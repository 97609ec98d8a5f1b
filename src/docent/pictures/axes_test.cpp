#include "docent/pictures/axes.h"

#include <gtest/gtest.h>

namespace docent::pictures {
namespace {

TEST(Axes, MapMetresToThePage) {
  const Axes axes = Axes::metres(GridFrame{40, 20, 0.1, {-1.0, 2.0}}, 400.0);
  EXPECT_DOUBLE_EQ(axes.width(), 400.0);
  EXPECT_DOUBLE_EQ(axes.height(), 200.0);
  EXPECT_DOUBLE_EQ(axes.scale(), 100.0);
  EXPECT_EQ(axes.page({-1.0, 4.0}), (Point2{0.0, 0.0}));
  EXPECT_EQ(axes.page({3.0, 2.0}), (Point2{400.0, 200.0}));
  EXPECT_NEAR(axes.page({0.37, 2.91}).x, 137.0, 1e-9);
  EXPECT_NEAR(axes.page({0.37, 2.91}).y, 109.0, 1e-9);
}

TEST(Axes, AMetreIsAsLongUpAsToTheRight) {
  for (const Point2 high : {Point2{50.0, 7.0}, Point2{3.0, 31.0}}) {
    const Axes axes = Axes::metres({0.0, 0.0}, high, 300.0);
    EXPECT_NEAR(axes.page({1.0, 1.0}).x - axes.page({0.0, 0.0}).x, axes.scale(), 1e-9);
    EXPECT_NEAR(axes.page({0.0, 0.0}).y - axes.page({1.0, 1.0}).y, axes.scale(), 1e-9);
    EXPECT_NEAR(std::max(axes.width(), axes.height()), 300.0, 1e-9);
  }
}

TEST(Axes, HaveScalesOfTheirOwnWhereNothingIsInMetres) {
  const Axes axes{{0.0, 0.0}, {10.0, 0.5}, 200.0, 50.0, "time [s]", "speed [m/s]"};
  EXPECT_EQ(axes.page({5.0, 0.25}), (Point2{100.0, 25.0}));
}

TEST(Axes, LeaveRoomForWhatStandsAround) {
  Axes axes = Axes::metres({0.0, 0.0}, {10.0, 10.0});
  const auto plain = axes.margins();
  EXPECT_GT(plain.left, 20.0);  // two lines of text, one of them turned
  EXPECT_GT(plain.bottom, 20.0);
  axes.set_title("a title");
  EXPECT_GT(axes.margins().top, plain.top);
  axes.set_color_bar({"time [s]", rainbow, 0.0, 90.0, false});
  EXPECT_GT(axes.margins().right, plain.right + 40.0);
  EXPECT_EQ(axes.description(), "a title: x [m], y [m], time [s]");
}

}  // namespace
}  // namespace docent::pictures
