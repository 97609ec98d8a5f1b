#include "docent/pictures/drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/pictures/text.h"

namespace docent {
namespace {

/// Total coverage in pixels of black shapes on white.
double ink(const Image& image) {
  double sum = 0.0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += 1.0 - image.at(x, y).red / 255.0;
  return sum;
}

TEST(Drawing, AreasAreRight) {
  Image disc{60, 60};
  fill_disc(disc, {30.3, 29.1}, 20.0, colors::kBlack);
  EXPECT_NEAR(ink(disc), std::numbers::pi * 400.0, 6.0);

  Image triangle{60, 60};
  const Point2 corners[] = {{5.2, 5.7}, {50.1, 11.0}, {20.0, 55.5}};
  fill_polygon(triangle, corners, colors::kBlack);
  EXPECT_NEAR(ink(triangle), 0.5 * std::abs(cross(corners[1] - corners[0], corners[2] - corners[0])), 2.0);

  Image line{60, 60};
  draw_line(line, {10, 10}, {50, 40}, 3.0, colors::kBlack);
  EXPECT_NEAR(ink(line), 50.0 * 3.0 + std::numbers::pi * 2.25, 3.0);
}

TEST(Drawing, EvenOddLeavesTheHoleOpen) {
  Image image{40, 40};
  // One outline that goes round the outer square, then along a seam round the inner one.
  const Point2 corners[] = {{5, 5},   {35, 5},  {35, 35}, {5, 35},  {5, 5},
                            {15, 15}, {25, 15}, {25, 25}, {15, 25}, {15, 15}};
  fill_polygon(image, corners, colors::kBlack);
  EXPECT_EQ(image.at(20, 20), colors::kWhite);
  EXPECT_EQ(image.at(10, 20), colors::kBlack);
}

TEST(Drawing, APolylineDoesNotDarkenItself) {
  Image image{40, 40};
  const Point2 points[] = {{5, 20}, {35, 20}, {5, 20}};
  draw_polyline(image, points, 6.0, with_alpha(colors::kBlack, 51));
  EXPECT_EQ(image.at(20, 20), (Color{204, 204, 204}));
}

TEST(Drawing, WhatLiesOutsideIsCut) {
  Image image{10, 10};
  draw_line(image, {-1e9, 5}, {1e9, 5}, 2.0, colors::kBlack);
  EXPECT_EQ(image.at(3, 5), colors::kBlack);
  fill_disc(image, {-100, -100}, 5, colors::kBlack);
  fill_disc(image, {std::nan(""), 0}, 5, colors::kBlack);
  const Point2 far[] = {{-1e12, -1e12}, {1e12, -1e12}, {0, 1e12}};
  fill_polygon(image, far, colors::kBlack);
  EXPECT_EQ(image.at(9, 9), colors::kBlack);
}

TEST(Text, EveryGlyphOfAsciiIsItsOwn) {
  std::vector<std::vector<std::uint8_t>> seen;
  for (char c = '!'; c <= '~'; ++c) {
    Image image{6, 11};
    draw_text(image, {0, 0}, std::string_view{&c, 1}, colors::kBlack);
    EXPECT_GT(ink(image), 0.0) << c;
    seen.emplace_back(image.bytes().begin(), image.bytes().end());
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(Text, MeasuresCharactersNotBytes) {
  EXPECT_EQ(text_width("abc"), text_width("äöü"));
  EXPECT_EQ(text_width("abc\nde"), 17);
  EXPECT_EQ(text_width("abc", 2), 34);
  Image broken{40, 11};
  draw_text(broken, {0, 0}, "\xff\xc3", colors::kBlack);  // no UTF-8: boxes, nothing worse
  EXPECT_GT(ink(broken), 10.0);
}

}  // namespace
}  // namespace docent
