#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/pictures/image.h"

namespace docent::pictures {

struct JpegSize {
  int width = 0;   ///< [pixels]
  int height = 0;  ///< [pixels]
};

/// The image as a baseline JPEG file (ITU-T T.81); alpha is left out. O(pixels).
/// @param quality  1 (small) .. 100 (good)
[[nodiscard]] std::vector<std::uint8_t> encode_jpeg(const Image& image, int quality);

/// What the file says of itself, without reading the picture. Error: no JPEG.
[[nodiscard]] Result<JpegSize> jpeg_size(std::span<const std::uint8_t> file);

/// Error: no JPEG, cut short, or with a side longer than `longest` pixels.
[[nodiscard]] Result<Image> decode_jpeg(std::span<const std::uint8_t> file, int longest = 4096);

}  // namespace docent::pictures
