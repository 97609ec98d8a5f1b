#include "docent/pictures/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numbers>
#include <vector>

namespace docent::pictures {
namespace {

constexpr double kFarthest = 1e5;      // [points]; Cairo's own numbers end at 8e6
constexpr double kLeastDensity = 4.0;  // [pixels a point], of bitmaps among vectors: what a printer shows

bool is_finite(Point2 point) { return std::isfinite(point.x) && std::isfinite(point.y); }

double cut(double value) { return std::clamp(value, -kFarthest, kFarthest); }

void set_color(cairo_t* context, Color color) {
  cairo_set_source_rgba(context, color.red / 255.0, color.green / 255.0, color.blue / 255.0, color.alpha / 255.0);
}

/// As Cairo has it: premultiplied.
std::uint32_t argb(Color color) {
  const auto share = [&color](std::uint8_t channel) { return (channel * color.alpha + 127U) / 255U; };
  return static_cast<std::uint32_t>(color.alpha) << 24U | share(color.red) << 16U | share(color.green) << 8U |
         share(color.blue);
}

/// White, a 255th of it. What is clear is black, and that shows at the edges where a program smooths a bitmap.
constexpr std::uint32_t kAllButClear = 0x01010101;

/// Bytes of a UTF-8 character that begins with `lead`; 0 where none does.
std::size_t length_of(unsigned char lead) {
  if (lead < 0x80) return 1;
  if (lead < 0xC2) return 0;
  if (lead < 0xE0) return 2;
  if (lead < 0xF0) return 3;
  return lead < 0xF5 ? 4 : 0;
}

/// Cairo refuses text with a single bad byte.
std::string valid_utf8(std::string_view text) {
  std::string valid;
  while (!text.empty()) {
    const std::size_t length = length_of(static_cast<unsigned char>(text[0]));
    bool good = length > 0 && length <= text.size() && text[0] != '\0';
    for (std::size_t i = 1; good && i < length; ++i) good = (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
    const auto second = static_cast<unsigned char>(good && length > 2 ? text[1] : 0);
    // Overlong forms, halves of a surrogate pair, beyond the last character.
    if (length == 3) good = good && !(text[0] == '\xE0' && second < 0xA0) && !(text[0] == '\xED' && second >= 0xA0);
    if (length == 4) good = good && !(text[0] == '\xF0' && second < 0x90) && !(text[0] == '\xF4' && second >= 0x90);
    valid += good ? text.substr(0, length) : std::string_view{"\uFFFD"};
    text.remove_prefix(good ? length : 1);
  }
  return valid;
}

void select_font(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size);
  // The same places on every kind of page.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

/// Width, ascent and descent of a line in the font that is selected.
struct Line {
  double width = 0.0;
  double ascent = 0.0;
  double descent = 0.0;
};
Line measure(cairo_t* context, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, text.c_str(), &extents);
  cairo_font_extents_t font;
  cairo_font_extents(context, &font);
  return {extents.x_advance, font.ascent, font.descent};
}

}  // namespace

Canvas::Canvas(cairo_t* context) : context_{context} {
  cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
  cairo_set_fill_rule(context_, CAIRO_FILL_RULE_EVEN_ODD);
}

/// Whether there is anything to draw.
bool Canvas::trace(std::span<const Point2> points) {
  cairo_new_path(context_);
  if (points.empty() || !std::all_of(points.begin(), points.end(), is_finite)) return false;
  for (const Point2& point : points) cairo_line_to(context_, cut(point.x), cut(point.y));
  return true;
}

void Canvas::stroke(double width, Color color) {
  set_color(context_, color);
  cairo_set_line_width(context_, width);
  cairo_stroke(context_);
}

void Canvas::fill_polygon(std::span<const Point2> corners, Color color) {
  if (corners.size() < 3 || !trace(corners)) return;
  set_color(context_, color);
  cairo_fill(context_);
}

void Canvas::draw_polygon(std::span<const Point2> corners, double width, Color color) {
  if (!trace(corners)) return;
  cairo_close_path(context_);
  stroke(width, color);
}

void Canvas::draw_polyline(std::span<const Point2> points, double width, Color color) {
  if (!trace(points)) return;
  if (points.size() == 1) cairo_close_path(context_);
  stroke(width, color);
}

void Canvas::draw_line(Point2 from, Point2 to, double width, Color color) {
  const Point2 ends[] = {from, to};
  draw_polyline(ends, width, color);
}

void Canvas::draw_arrow(Point2 from, Point2 to, double width, Color color) {
  const double length = distance(from, to);
  if (!(length > 0.0)) return;
  const Point2 along = 1.0 / length * (to - from);
  const Point2 across{-along.y, along.x};
  const double head = std::min(length, 4.0 * width);
  const Point2 neck = to - head * along;
  draw_line(from, neck, width, color);
  const Point2 corners[] = {to, neck + 0.5 * head * across, neck - 0.5 * head * across};
  fill_polygon(corners, color);
}

void Canvas::fill_discs(std::span<const Point2> centres, double diameter, Color color) {
  cairo_new_path(context_);
  for (const Point2& centre : centres) {
    if (!is_finite(centre)) continue;
    cairo_move_to(context_, cut(centre.x), cut(centre.y));  // a line of no length with round ends is a disc
    cairo_close_path(context_);
  }
  stroke(diameter, color);
}

void Canvas::draw_circle(Point2 centre, double radius, double width, Color color) {
  cairo_new_path(context_);
  if (!is_finite(centre) || !(radius >= 0.0)) return;
  cairo_arc(context_, cut(centre.x), cut(centre.y), std::min(radius, kFarthest), 0.0, 2.0 * std::numbers::pi);
  cairo_close_path(context_);
  stroke(width, color);
}

void Canvas::fill_rectangle(Point2 top_left, Point2 bottom_right, Color color) {
  const Point2 corners[] = {top_left, {bottom_right.x, top_left.y}, bottom_right, {top_left.x, bottom_right.y}};
  fill_polygon(corners, color);
}

void Canvas::draw_image(const Image& image, Point2 top_left, Point2 bottom_right) {
  const double width = bottom_right.x - top_left.x;
  const double height = bottom_right.y - top_left.y;
  // Many programs that show vectors smooth the bitmaps in them: magnified ones stay sharp all the same.
  const bool is_raster = cairo_surface_get_type(cairo_get_target(context_)) == CAIRO_SURFACE_TYPE_IMAGE;
  const double largest_pixel = std::max(width / image.width(), height / image.height());
  const int magnified = is_raster ? 1 : std::max(1, static_cast<int>(std::ceil(kLeastDensity * largest_pixel)));
  const std::unique_ptr<cairo_surface_t, CairoDeleter> surface{
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, magnified * image.width(), magnified * image.height())};
  cairo_surface_flush(surface.get());
  for (int y = 0; y < magnified * image.height(); ++y) {
    for (int x = 0; x < magnified * image.width(); ++x) {
      const Color color = image.at(x / magnified, y / magnified);
      const std::uint32_t pixel = color.alpha > 0 || is_raster ? argb(color) : kAllButClear;
      std::memcpy(pixel_of(surface.get(), x, y), &pixel, sizeof pixel);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  cairo_save(context_);
  cairo_translate(context_, top_left.x, top_left.y);
  cairo_scale(context_, width / (magnified * image.width()), height / (magnified * image.height()));
  cairo_set_source_surface(context_, surface.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context_), CAIRO_FILTER_NEAREST);
  cairo_paint(context_);
  cairo_restore(context_);
}

void Canvas::draw_text(Point2 at, std::string_view utf8, const TextStyle& style) {
  if (!is_finite(at)) return;
  const std::string text = valid_utf8(utf8);
  cairo_save(context_);
  select_font(context_, style);
  const Line line = measure(context_, text);
  cairo_translate(context_, cut(at.x), cut(at.y));
  if (style.upwards) cairo_rotate(context_, -0.5 * std::numbers::pi);
  set_color(context_, style.color);
  cairo_move_to(context_, -style.anchor.x * line.width, line.ascent - style.anchor.y * (line.ascent + line.descent));
  cairo_show_text(context_, text.c_str());
  cairo_restore(context_);
}

void Canvas::draw_label(Point2 at, std::string_view utf8, const TextStyle& style, Color plate) {
  constexpr double kMargin = 1.0;
  const Point2 size = text_size(utf8, style);
  const Point2 top_left = at - Point2{style.anchor.x * size.x + kMargin, style.anchor.y * size.y};
  fill_rectangle(top_left, top_left + Point2{size.x + 2.0 * kMargin, size.y}, plate);
  draw_text(at, utf8, style);
}

unsigned char* pixel_of(cairo_surface_t* surface, int x, int y) {
  return cairo_image_surface_get_data(surface) +
         static_cast<std::ptrdiff_t>(cairo_image_surface_get_stride(surface)) * y + std::ptrdiff_t{4} * x;
}

Point2 text_size(std::string_view utf8, const TextStyle& style) {
  const std::unique_ptr<cairo_surface_t, CairoDeleter> surface{
      cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, nullptr)};
  const std::unique_ptr<cairo_t, CairoDeleter> context{cairo_create(surface.get())};
  select_font(context.get(), style);
  const Line line = measure(context.get(), valid_utf8(utf8));
  return {line.width, line.ascent + line.descent};
}

}  // namespace docent::pictures
