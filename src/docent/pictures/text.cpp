#include "docent/pictures/text.h"

#include <algorithm>
#include <cmath>

#include "docent/pictures/drawing.h"
#include "docent/pictures/font.h"

namespace docent {
namespace {

constexpr int kColumns = 5;
constexpr int kAdvance = 6;
constexpr Glyph kMissing{0, {0x1f, 0x11, 0x11, 0x11, 0x11, 0x11, 0x1f, 0x00, 0x00}};

/// Takes the next code point off `rest`. A byte that is no UTF-8 counts as one unknown character.
char32_t next_code(std::string_view& rest) {
  const auto byte = [&rest](std::size_t i) { return static_cast<unsigned char>(rest[i]); };
  const unsigned char lead = byte(0);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC0 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF8 ? 4
                                           : 0;
  if (length == 1) {
    rest.remove_prefix(1);
    return lead;
  }
  if (length == 0 || rest.size() < length) {
    rest.remove_prefix(1);
    return 0;
  }
  char32_t code = static_cast<char32_t>(lead & (0x7F >> length));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) {
      rest.remove_prefix(1);
      return 0;
    }
    code = (code << 6U) | (byte(i) & 0x3FU);
  }
  rest.remove_prefix(length);
  return code;
}

const Glyph& glyph_of(char32_t code) {
  const auto found = std::lower_bound(kFont.begin(), kFont.end(), code,
                                      [](const Glyph& glyph, char32_t wanted) { return glyph.code < wanted; });
  return found != kFont.end() && found->code == code ? *found : kMissing;
}

}  // namespace

int text_width(std::string_view utf8, int scale) {
  int longest = 0;
  int here = 0;
  while (!utf8.empty()) {
    here = next_code(utf8) == U'\n' ? 0 : here + kAdvance;
    longest = std::max(longest, here);
  }
  return std::max(0, longest - 1) * scale;
}

void draw_text(Image& image, Point2 top_left, std::string_view utf8, Color color, int scale) {
  const int left = static_cast<int>(std::lround(top_left.x));
  int x = left;
  int y = static_cast<int>(std::lround(top_left.y));
  while (!utf8.empty()) {
    const char32_t code = next_code(utf8);
    if (code == U'\n') {
      x = left;
      y += text_height(scale);
      continue;
    }
    const Glyph& glyph = glyph_of(code);
    for (int row = 0; row < static_cast<int>(glyph.rows.size()) * scale; ++row)
      for (int column = 0; column < kColumns * scale; ++column)
        if ((glyph.rows[static_cast<std::size_t>(row / scale)] >> (kColumns - 1 - column / scale) & 1) != 0)
          image.blend(x + column, y + row, color);
    x += kAdvance * scale;
  }
}

void draw_label(Image& image, Point2 top_left, std::string_view utf8, Color color, Color plate, int scale) {
  const auto lines = 1 + std::count(utf8.begin(), utf8.end(), '\n');
  const double margin = 2.0 * scale;
  fill_rectangle(image, {std::round(top_left.x) - margin, std::round(top_left.y) - margin},
                 {std::round(top_left.x) + text_width(utf8, scale) + margin,
                  std::round(top_left.y) + static_cast<double>(lines * text_height(scale))},
                 plate);
  draw_text(image, top_left, utf8, color, scale);
}

}  // namespace docent
