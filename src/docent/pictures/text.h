#pragma once

#include <string_view>

#include "docent/geometry/pose2.h"
#include "docent/pictures/image.h"

namespace docent {

/// Height of a line of text in pixels at `scale`, the space to the next line included.
[[nodiscard]] constexpr int text_height(int scale = 1) { return 11 * scale; }
/// Width of one line in pixels.
[[nodiscard]] int text_width(std::string_view utf8, int scale = 1);

/// Draws text in Docent's own 5 x 9 dot font; `top_left` in pixels, '\n' starts a new line. Latin letters, digits,
/// signs of ASCII and German umlauts; what the font lacks shows as a box.
void draw_text(Image& image, Point2 top_left, std::string_view utf8, Color color, int scale = 1);
/// The same on a plate of `plate` colour, so that it can be read over a map.
void draw_label(Image& image, Point2 top_left, std::string_view utf8, Color color, Color plate, int scale = 1);

}  // namespace docent
