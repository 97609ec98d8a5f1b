#pragma once

#include <cairo.h>

#include <span>
#include <string>
#include <string_view>

#include "docent/geometry/pose2.h"
#include "docent/pictures/image.h"

namespace docent::pictures {

struct TextStyle {
  double size = 9.0;  ///< [points]
  Color color = colors::kInk;
  /// The part of the text's box that lies left of and above its place: {0, 0} begins there, {0.5, 0.5} is centred.
  Point2 anchor{};
  bool bold = false;
  bool upwards = false;  ///< turned to the left by a quarter, about its place
};

/// Draws on a page by Cairo. All places and lengths are points (1/72 inch), x to the right, y down. What is no number
/// is not drawn.
class Canvas {
 public:
  /// @pre `context` outlives the canvas
  explicit Canvas(cairo_t* context);

  /// Even-odd; corners in order, the last joins the first.
  void fill_polygon(std::span<const Point2> corners, Color color);
  void draw_polygon(std::span<const Point2> corners, double width, Color color);
  /// As one shape with round ends: where its parts overlap a transparent colour does not add up.
  void draw_polyline(std::span<const Point2> points, double width, Color color);
  void draw_line(Point2 from, Point2 to, double width, Color color);
  /// A line with a head at `to`.
  void draw_arrow(Point2 from, Point2 to, double width, Color color);
  /// As one shape, like a polyline.
  void fill_discs(std::span<const Point2> centres, double diameter, Color color);
  void draw_circle(Point2 centre, double radius, double width, Color color);
  void fill_rectangle(Point2 top_left, Point2 bottom_right, Color color);
  /// Stretched over the rectangle; pixels stay sharp squares.
  void draw_image(const Image& image, Point2 top_left, Point2 bottom_right);
  /// One line of UTF-8; bytes that are no UTF-8 show as a question mark in a box.
  void draw_text(Point2 at, std::string_view utf8, const TextStyle& style);
  /// The same on a plate of `plate` colour, so that it can be read over a map.
  void draw_label(Point2 at, std::string_view utf8, const TextStyle& style, Color plate);

  /// Runs `draw` with `place` as the origin.
  template <class Draw>
  void at(Point2 place, const Draw& draw) {
    cairo_save(context_);
    cairo_translate(context_, place.x, place.y);
    draw(*this);
    cairo_restore(context_);
  }
  /// Runs `draw`, of which only what lies inside the rectangle is seen.
  template <class Draw>
  void within(Point2 top_left, Point2 bottom_right, const Draw& draw) {
    cairo_save(context_);
    cairo_rectangle(context_, top_left.x, top_left.y, bottom_right.x - top_left.x, bottom_right.y - top_left.y);
    cairo_clip(context_);
    draw(*this);
    cairo_restore(context_);
  }

 private:
  bool trace(std::span<const Point2> points);
  void stroke(double width, Color color);
  cairo_t* context_;
};

/// Width and height [points] of one line of text, not turned.
[[nodiscard]] Point2 text_size(std::string_view utf8, const TextStyle& style);

/// Ends of a Cairo object's life.
struct CairoDeleter {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};

/// The four bytes of a pixel of an image surface. @pre (x, y) lies in it
[[nodiscard]] unsigned char* pixel_of(cairo_surface_t* surface, int x, int y);

}  // namespace docent::pictures
