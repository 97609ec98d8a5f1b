#include "docent/pictures/canvas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

namespace docent::pictures {
namespace {

/// A white page of pixels, one a point.
class Page {
 public:
  Page(int width, int height)
      : surface_{cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)},
        context_{cairo_create(surface_.get())} {
    cairo_set_source_rgb(context_.get(), 1.0, 1.0, 1.0);
    cairo_paint(context_.get());
  }
  Canvas canvas() { return Canvas{context_.get()}; }
  [[nodiscard]] bool is_fine() const { return cairo_status(context_.get()) == CAIRO_STATUS_SUCCESS; }
  [[nodiscard]] Color at(int x, int y) const {
    cairo_surface_flush(surface_.get());
    const unsigned char* pixel = pixel_of(surface_.get(), x, y);
    return {pixel[2], pixel[1], pixel[0]};  // of a little-endian machine
  }
  /// Total coverage in pixels of black shapes.
  [[nodiscard]] double ink() const {
    double sum = 0.0;
    for (int y = 0; y < cairo_image_surface_get_height(surface_.get()); ++y)
      for (int x = 0; x < cairo_image_surface_get_width(surface_.get()); ++x) sum += 1.0 - at(x, y).red / 255.0;
    return sum;
  }

 private:
  std::unique_ptr<cairo_surface_t, CairoDeleter> surface_;
  std::unique_ptr<cairo_t, CairoDeleter> context_;
};

TEST(Canvas, AreasAreRight) {
  Page disc{60, 60};
  const Point2 centres[] = {{30.3, 29.1}};
  disc.canvas().fill_discs(centres, 40.0, colors::kBlack);
  EXPECT_NEAR(disc.ink(), std::numbers::pi * 400.0, 6.0);

  Page triangle{60, 60};
  const Point2 corners[] = {{5.2, 5.7}, {50.1, 11.0}, {20.0, 55.5}};
  triangle.canvas().fill_polygon(corners, colors::kBlack);
  EXPECT_NEAR(triangle.ink(), 0.5 * std::abs(cross(corners[1] - corners[0], corners[2] - corners[0])), 2.0);

  Page line{60, 60};
  line.canvas().draw_line({10, 10}, {50, 40}, 3.0, colors::kBlack);
  EXPECT_NEAR(line.ink(), 50.0 * 3.0 + std::numbers::pi * 2.25, 3.0);

  Page circle{60, 60};
  circle.canvas().draw_circle({30.0, 30.0}, 20.0, 2.0, colors::kBlack);
  EXPECT_NEAR(circle.ink(), 2.0 * std::numbers::pi * 20.0 * 2.0, 4.0);
}

TEST(Canvas, EvenOddLeavesTheHoleOpen) {
  Page page{40, 40};
  // One outline that goes round the outer square, then along a seam round the inner one.
  const Point2 corners[] = {{5, 5},   {35, 5},  {35, 35}, {5, 35},  {5, 5},
                            {15, 15}, {25, 15}, {25, 25}, {15, 25}, {15, 15}};
  page.canvas().fill_polygon(corners, colors::kBlack);
  EXPECT_EQ(page.at(20, 20), colors::kWhite);
  EXPECT_EQ(page.at(10, 20), colors::kBlack);
}

TEST(Canvas, APolylineDoesNotDarkenItself) {
  Page page{40, 40};
  const Point2 points[] = {{5, 20}, {35, 20}, {5, 20}};
  page.canvas().draw_polyline(points, 6.0, with_alpha(colors::kBlack, 51));
  EXPECT_EQ(page.at(20, 20), (Color{204, 204, 204}));
}

TEST(Canvas, WhatLiesOutsideIsCutAndWhatIsNoNumberIsLeftOut) {
  Page page{10, 10};
  Canvas canvas = page.canvas();
  canvas.draw_line({-1e9, 5}, {1e9, 5}, 2.0, colors::kBlack);
  EXPECT_EQ(page.at(3, 5), colors::kBlack);
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const Point2 discs[] = {{-100, -100}, {nan, 0}, {infinity, 1}};
  canvas.fill_discs(discs, 10.0, colors::kBlack);
  canvas.draw_circle({nan, 0.0}, 3.0, 1.0, colors::kBlack);
  canvas.draw_circle({5.0, 5.0}, nan, 1.0, colors::kBlack);
  canvas.draw_text({0.0, infinity}, "far", {});
  EXPECT_EQ(page.at(9, 1), colors::kWhite);
  const Point2 far[] = {{-1e12, -1e12}, {1e12, -1e12}, {0, 1e12}};
  canvas.fill_polygon(far, colors::kBlack);
  EXPECT_EQ(page.at(9, 9), colors::kBlack);
  EXPECT_TRUE(page.is_fine());
}

TEST(Canvas, PixelsOfAnImageStaySharp) {
  Page page{20, 10};
  Image image{2, 1, colors::kBlack};
  image.set(1, 0, colors::kRed);
  page.canvas().draw_image(image, {0.0, 0.0}, {20.0, 10.0});
  EXPECT_EQ(page.at(9, 5), colors::kBlack);
  EXPECT_EQ(page.at(10, 5), colors::kRed);

  Page half{2, 2};
  half.canvas().draw_image(Image{1, 1, with_alpha(colors::kBlack, 51)}, {0.0, 0.0}, {2.0, 2.0});
  EXPECT_EQ(half.at(1, 1), (Color{204, 204, 204}));
}

TEST(Text, IsWhereItsAnchorSays) {
  const TextStyle style{.size = 10.0, .color = colors::kBlack};
  const Point2 size = text_size("wide words", style);
  EXPECT_GT(size.x, 40.0);
  EXPECT_LT(size.x, 80.0);
  const auto ink_at = [&](Point2 anchor, bool upwards) {
    Page page{200, 200};
    TextStyle anchored = style;
    anchored.anchor = anchor;
    anchored.upwards = upwards;
    page.canvas().draw_text({100.0, 100.0}, "wide words", anchored);
    Point2 low{200.0, 200.0};
    Point2 high{0.0, 0.0};
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 200; ++x)
        if (page.at(x, y).red < 128) {
          low = {std::min(low.x, double(x)), std::min(low.y, double(y))};
          high = {std::max(high.x, double(x)), std::max(high.y, double(y))};
        }
    return std::pair{low, high};
  };
  const auto [low, high] = ink_at({0.0, 0.0}, false);
  EXPECT_GE(low.x, 99.0);
  EXPECT_GE(low.y, 100.0);
  EXPECT_NEAR(high.x, 100.0 + size.x, 3.0);
  EXPECT_NEAR(ink_at({1.0, 0.0}, false).second.x, 100.0, 3.0);
  EXPECT_LE(ink_at({0.0, 1.0}, false).second.y, 100.0);
  const auto [up_low, up_high] = ink_at({0.0, 0.0}, true);  // from below to above, its lines to the right
  EXPECT_NEAR(up_low.y, 100.0 - size.x, 3.0);
  EXPECT_GE(up_low.x, 100.0);
  EXPECT_LE(up_high.y, 101.0);
}

TEST(Text, EveryLetterOfAsciiIsItsOwn) {
  std::vector<std::vector<std::uint8_t>> seen;
  for (char c = '!'; c <= '~'; ++c) {
    Page page{16, 20};
    page.canvas().draw_text({1.0, 1.0}, std::string_view{&c, 1}, {.size = 14.0, .color = colors::kBlack});
    EXPECT_GT(page.ink(), 0.0) << c;
    seen.emplace_back();
    for (int y = 0; y < 20; ++y)
      for (int x = 0; x < 16; ++x) seen.back().push_back(page.at(x, y).red);
  }
  std::sort(seen.begin(), seen.end());
  EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(Text, MeasuresCharactersNotBytes) {
  EXPECT_DOUBLE_EQ(text_size("aou", {}).x, text_size("äöü", {}).x);
  EXPECT_NEAR(text_size("abc", {.size = 18.0}).x, 2.0 * text_size("abc", {.size = 9.0}).x, 0.1);
}

TEST(Text, WhatIsNoUtf8ShowsAsAMark) {
  // A bad lead, a letter cut short, a surrogate, an overlong slash, a zero: each of the bytes is one mark.
  for (const auto& [bytes, marks] :
       {std::pair{std::string{"\xff"}, 1}, std::pair{std::string{"\xc3"}, 1}, std::pair{std::string{"\xed\xa0\x80"}, 3},
        std::pair{std::string{"\xc0\xaf"}, 2}, std::pair{std::string(1, '\0'), 1}}) {
    Page page{80, 20};
    page.canvas().draw_text({2.0, 2.0}, bytes, {.size = 12.0, .color = colors::kBlack});
    EXPECT_TRUE(page.is_fine());
    EXPECT_GT(page.ink(), 5.0 * marks);
    EXPECT_NEAR(text_size(bytes, {}).x, marks * text_size("\uFFFD", {}).x, 1e-9);
  }
}

}  // namespace
}  // namespace docent::pictures
