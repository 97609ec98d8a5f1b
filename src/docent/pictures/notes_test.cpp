#include "docent/pictures/notes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "docent/pictures/figure.h"

namespace docent::pictures {
namespace {

/// Rows of pixels that hold letters.
int rows_with_letters(const Image& image) {
  int rows = 0;
  for (int y = 0; y < image.height(); ++y) {
    bool has_letter = false;
    for (int x = 0; x < image.width(); ++x) has_letter |= image.at(x, y).red < 100;
    rows += has_letter ? 1 : 0;
  }
  return rows;
}

TEST(DrawNotes, StayInsideTheFrame) {
  for (const Point2 place : {Point2{0.0, 0.0}, Point2{4.0, 2.0}, Point2{-3.0, 9.0}}) {
    const Point2 size = text_size("a long name", {.size = 6.5});
    Axes axes = Axes::metres({0, 0}, {4, 2}, 100.0);
    const std::array<Note, 1> notes{Note{place, "a long name", {0.5, 0.5}}};
    draw_notes(axes, notes);
    const Image image = raster_inside(axes);
    int left = image.width();
    int right = 0;
    for (int y = 0; y < image.height(); ++y)
      for (int x = 0; x < image.width(); ++x)
        if (image.at(x, y).red < 100) {
          left = std::min(left, x);
          right = std::max(right, x);
        }
    EXPECT_NEAR((right - left) / kPixelsPerPoint, size.x, 2.0) << place.x;
  }
}

TEST(DrawNotes, DoNotLieOnEachOtherNorOnADot) {
  const auto rows_of = [](std::span<const Note> notes, std::span<const Point2> dots) {
    Axes axes = Axes::metres({0, 0}, {4, 2}, 100.0);
    draw_notes(axes, notes, dots, 4.0);
    return rows_with_letters(raster_inside(axes));
  };
  const std::array<Note, 3> same{Note{{2.0, 1.0}, "oven", {0.5, 0.5}}, Note{{2.1, 1.02}, "oven", {0.5, 0.5}},
                                 Note{{1.9, 0.99}, "oven", {0.5, 0.5}}};
  const int alone = rows_of(std::span{same}.first(1), {});
  EXPECT_EQ(rows_of(same, {}), 3 * alone) << "one above the other";
  const std::array<Note, 2> apart{Note{{1.0, 1.0}, "oven", {0.5, 0.5}}, Note{{3.0, 1.0}, "oven", {0.5, 0.5}}};
  EXPECT_EQ(rows_of(apart, {}), alone) << "those that have room stay where they belong";

  Axes axes = Axes::metres({0, 0}, {4, 2}, 100.0);
  const std::array<Point2, 1> dot{Point2{2.0, 1.0}};
  draw_notes(axes, std::span{same}.first(1), dot, 4.0);
  const Image image = raster_inside(axes);
  for (int y = 47; y <= 53; ++y) EXPECT_GE(image.at(100, y).red, 100) << "a letter on the dot";
}

}  // namespace
}  // namespace docent::pictures
