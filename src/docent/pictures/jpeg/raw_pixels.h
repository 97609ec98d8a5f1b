#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "docent/base/result.h"
#include "docent/pictures/image.h"

namespace docent::pictures {

/// How the pixels of a camera lie in memory, as ROS 2 says it.
struct RawPixels {
  int width = 0;              ///< [pixels]
  int height = 0;             ///< [pixels]
  std::size_t step = 0;       ///< [bytes] from row to row
  std::string encoding;       ///< rgb8, bgr8, rgba8, bgra8, mono8, mono16, yuv422 (UYVY), yuv422_yuy2, uyvy, yuyv
  bool is_bigendian = false;  ///< of mono16
  std::span<const std::uint8_t> rows;  ///< from the top
};

/// Error: an encoding that is not read (those of raw sensors and of depths), rows that do not fill the picture, a side
/// of nothing or longer than `longest`. O(pixels).
[[nodiscard]] Result<Image> image_of(const RawPixels& pixels, int longest = 4096);

}  // namespace docent::pictures
