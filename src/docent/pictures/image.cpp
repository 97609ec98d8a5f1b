#include "docent/pictures/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace docent::pictures {
namespace {

constexpr int kMaxSide = 16384;

}  // namespace

Image::Image(int width, int height, Color background) : width_{width}, height_{height} {
  DOCENT_CHECK(width > 0 && height > 0 && width <= kMaxSide && height <= kMaxSide);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::array pixel{background.red, background.green, background.blue, background.alpha};
  bytes_.resize(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) std::memcpy(&bytes_[4 * i], pixel.data(), pixel.size());
}

void Image::blend(int x, int y, Color color, double coverage) {
  if (!holds(x, y) || !(coverage > 0.0)) return;
  const double over = std::min(coverage, 1.0) * color.alpha / 255.0;
  const Color under = at(x, y);
  const double under_alpha = under.alpha / 255.0 * (1.0 - over);
  const double alpha = over + under_alpha;
  if (alpha <= 0.0) return;
  const auto channel = [&](std::uint8_t top, std::uint8_t bottom) {
    return static_cast<std::uint8_t>(std::lround((top * over + bottom * under_alpha) / alpha));
  };
  set(x, y,
      {channel(color.red, under.red), channel(color.green, under.green), channel(color.blue, under.blue),
       static_cast<std::uint8_t>(std::lround(alpha * 255.0))});
}

}  // namespace docent::pictures
