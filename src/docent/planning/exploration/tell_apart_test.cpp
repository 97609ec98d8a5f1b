#include "docent/planning/exploration/tell_apart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace docent::planning::tell_apart_test {
namespace {

constexpr double kRange = 10.0;  // [m] of the laser

/// A corridor of 24 x 2.4 m, its middle at (12, 1.2), the same from both ends but for an alcove in the side wall at x
/// from 18 to 19.
OccupancyGrid corridor() {
  OccupancyGrid map;
  map.frame = {260, 64, 0.1, {-1.0, -1.0}};
  map.cells.assign(map.frame.size(), 100);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const auto column = static_cast<double>(i % 260);
    const auto row = static_cast<double>(i / 260);
    const Point2 at{-1.0 + 0.1 * (column + 0.5), -1.0 + 0.1 * (row + 0.5)};
    const bool hall = at.x > 0.0 && at.x < 24.0 && at.y > 0.0 && at.y < 2.4;
    const bool alcove = at.x > 18.0 && at.x < 19.0 && at.y > 2.0 && at.y < 4.0;
    if (hall || alcove) map.cells[i] = 0;
  }
  return map;
}

/// The robot looks along the corridor, or, the other way, from the mirrored place: the same readings but for the
/// alcove.
std::vector<PossiblePose> two_ends(double x) {
  return {{{x, 1.2, {}}, 0.5}, {{24.0 - x, 1.2, Angle::degrees(180)}, 0.5}};
}

std::vector<double> open_along(double ahead, double behind) {
  std::vector<double> clearances(180, 1.2);
  for (std::size_t i = 0; i < clearances.size(); ++i) {
    const double off = std::abs(-180.0 + 2.0 * static_cast<double>(i));
    if (off < 30.0) clearances[i] = ahead;
    if (off > 150.0) clearances[i] = behind;
  }
  return clearances;
}

TEST(TellApart, DrivesTowardsWhatDiffers) {
  const TellApart tell{corridor(), 0.27, {}};
  // The alcove is four metres ahead, or, for a robot at x = 10 that looks back, eight metres behind.
  const auto place = tell.best_place(two_ends(14.0), open_along(8.0, 8.0), kRange);
  ASSERT_TRUE(place.has_value());
  EXPECT_GT(std::abs(place->in_base.x), 1.0);
  EXPECT_GT(place->gain, 0.1);
  // Nearer to the alcove less is left to find out.
  const auto now = tell.expected_entropy(two_ends(14.0), {}, kRange);
  EXPECT_LT(tell.expected_entropy(two_ends(14.0), {3.5, 0.0}, kRange), 0.8 * now);
}

TEST(TellApart, StaysWithinWhatIsFree) {
  const TellApart tell{corridor(), 0.27, {}};
  const auto place = tell.best_place(two_ends(14.0), open_along(2.8, 8.0), kRange);
  ASSERT_TRUE(place.has_value());
  EXPECT_LE(place->in_base.x, 2.8 - TellApartParams{}.keep_off);
  EXPECT_FALSE(tell.best_place(two_ends(14.0), open_along(1.0, 1.0), kRange).has_value());
  EXPECT_FALSE(tell.best_place(two_ends(14.0), {}, kRange).has_value());
}

TEST(TellApart, NothingToTellWhereAllLooksTheSame) {
  OccupancyGrid map = corridor();  // without the alcove the two ends are one
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (-1.0 + 0.1 * static_cast<double>(i / 260) > 2.45) map.cells[i] = 100;
  }
  const TellApart tell{map, 0.27, {}};
  EXPECT_FALSE(tell.best_place(two_ends(14.0), open_along(8.0, 8.0), kRange).has_value());
  EXPECT_NEAR(tell.expected_entropy(two_ends(14.0), {2.0, 0.0}, kRange), std::log(2.0), 1e-2);
}

TEST(TellApart, NeedsTwoHypothesesThatHoldMostOfTheBelief) {
  const TellApart tell{corridor(), 0.27, {}};
  auto hypotheses = two_ends(14.0);
  const auto open = open_along(8.0, 8.0);
  EXPECT_FALSE(tell.best_place(std::span{hypotheses}.first(1), open, kRange).has_value());
  for (auto& hypothesis : hypotheses) hypothesis.mass = 0.1;
  EXPECT_FALSE(tell.best_place(hypotheses, open, kRange).has_value());
}

TEST(TellApart, AWallWhereOneHypothesisWouldStandTellsThemApart) {
  const TellApart tell{corridor(), 0.27, {}};
  const std::vector<PossiblePose> hypotheses{{{5.0, 1.2, {}}, 0.5}, {{5.0, 1.2, Angle::degrees(90)}, 0.5}};
  EXPECT_LT(tell.expected_entropy(hypotheses, {3.0, 0.0}, kRange), 0.01);
}

TEST(TellApartParams, RefusesNonsense) {
  EXPECT_TRUE(TellApartParams{}.validate());
  EXPECT_FALSE((TellApartParams{.least_gain = 0.0}.validate()));
  EXPECT_FALSE((TellApartParams{.longest_way = 100.0}.validate()));
  EXPECT_FALSE((TellApartParams{.keep_off = 0.0}.validate()));
}

}  // namespace
}  // namespace docent::planning::tell_apart_test
