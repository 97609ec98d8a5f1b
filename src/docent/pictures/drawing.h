#pragma once

#include <span>

#include "docent/geometry/pose2.h"
#include "docent/pictures/image.h"

// Anti-aliased shapes. All coordinates are pixels of the image (x right, y down); what lies outside is cut.

namespace docent {

/// Even-odd filling; corners in order, the last joins the first.
void fill_polygon(Image& image, std::span<const Point2> corners, Color color);
void draw_polygon(Image& image, std::span<const Point2> corners, double width, Color color);

/// A line of `width` pixels with round ends.
void draw_line(Image& image, Point2 from, Point2 to, double width, Color color);
/// As one shape: where its parts overlap a transparent colour does not add up.
void draw_polyline(Image& image, std::span<const Point2> points, double width, Color color);
/// A line with a head at `to`.
void draw_arrow(Image& image, Point2 from, Point2 to, double width, Color color);

void fill_disc(Image& image, Point2 centre, double radius, Color color);
void draw_circle(Image& image, Point2 centre, double radius, double width, Color color);

/// Axis-parallel, both corners in pixels.
void fill_rectangle(Image& image, Point2 top_left, Point2 bottom_right, Color color);

}  // namespace docent
