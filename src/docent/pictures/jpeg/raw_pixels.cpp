#include "docent/pictures/jpeg/raw_pixels.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace docent::pictures {
namespace {

/// Where the parts of a pixel lie in its bytes.
struct Layout {
  std::size_t bytes;  ///< of a pixel; of YUV a pair has twice as many
  std::size_t red = 0, green = 0, blue = 0;
  bool is_yuv = false;         ///< two pixels share their colour
  std::size_t brightness = 0;  ///< of a pair, that of the first; the second's is two farther
  std::size_t u = 0, v = 0;    ///< of a pair
  bool is_wide = false;        ///< 16 bits a pixel
};

const Layout* layout_of(const std::string& encoding) {
  static const std::map<std::string, Layout> kLayouts{
      {"rgb8", {3, 0, 1, 2}},
      {"bgr8", {3, 2, 1, 0}},
      {"rgba8", {4, 0, 1, 2}},
      {"bgra8", {4, 2, 1, 0}},
      {"8UC3", {3, 2, 1, 0}},
      {"8UC4", {4, 2, 1, 0}},
      {"mono8", {1, 0, 0, 0}},
      {"8UC1", {1, 0, 0, 0}},
      {"mono16", {2, 0, 0, 0, false, 0, 0, 0, true}},
      {"yuv422", {2, 0, 0, 0, true, 1, 0, 2}},
      {"uyvy", {2, 0, 0, 0, true, 1, 0, 2}},
      {"yuv422_yuy2", {2, 0, 0, 0, true, 0, 1, 3}},
      {"yuyv", {2, 0, 0, 0, true, 0, 1, 3}},
  };
  const auto found = kLayouts.find(encoding);
  return found == kLayouts.end() ? nullptr : &found->second;
}

std::uint8_t byte_of(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0))); }

/// ITU-R BT.601, as cameras of USB send it.
Color color_of_yuv(std::uint8_t brightness, std::uint8_t u, std::uint8_t v) {
  const double y = 1.164 * (brightness - 16.0);
  const double cb = u - 128.0, cr = v - 128.0;
  return {byte_of(y + 1.596 * cr), byte_of(y - 0.392 * cb - 0.813 * cr), byte_of(y + 2.017 * cb), 255};
}

Color color_at(const std::uint8_t* row, std::size_t x, const Layout& layout, bool is_bigendian) {
  if (layout.is_yuv) {
    const std::uint8_t* pair = row + x / 2 * 4;
    return color_of_yuv(pair[layout.brightness + x % 2 * 2], pair[layout.u], pair[layout.v]);
  }
  const std::uint8_t* pixel = row + x * layout.bytes;
  if (layout.is_wide) {
    const std::uint8_t grey = pixel[is_bigendian ? 0 : 1];
    return {grey, grey, grey, 255};
  }
  return {pixel[layout.red], pixel[layout.green], pixel[layout.blue], 255};
}

}  // namespace

Result<Image> image_of(const RawPixels& pixels, int longest) {
  const Layout* layout = layout_of(pixels.encoding);
  if (layout == nullptr) return fail("pixels of encoding '" + pixels.encoding + "' are not read");
  if (pixels.width < 1 || pixels.height < 1 || pixels.width > longest || pixels.height > longest)
    return fail("a side of nothing, or over " + std::to_string(longest) + " pixels");
  const std::size_t row =
      static_cast<std::size_t>(layout->is_yuv ? (pixels.width + 1) / 2 * 2 : pixels.width) * layout->bytes;
  if (pixels.step < row || pixels.rows.size() < pixels.step * static_cast<std::size_t>(pixels.height))
    return fail("rows that do not fill the picture");
  Image image{pixels.width, pixels.height};
  for (int y = 0; y < pixels.height; ++y) {
    const std::uint8_t* from = pixels.rows.data() + static_cast<std::size_t>(y) * pixels.step;
    for (int x = 0; x < pixels.width; ++x)
      image.set(x, y, color_at(from, static_cast<std::size_t>(x), *layout, pixels.is_bigendian));
  }
  return image;
}

}  // namespace docent::pictures
