#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "docent/base/result.h"
#include "docent/pictures/image.h"

namespace docent::pictures {

/// A PNG file of 8 bits, grey. @pre grey.size() == width * height, rows from the top. Error: no memory. O(pixels).
[[nodiscard]] Result<std::string> encode_png(int width, int height, std::span<const std::uint8_t> grey);
/// Of 16 bits, as depth cameras' pictures are stored.
[[nodiscard]] Result<std::string> encode_png(int width, int height, std::span<const std::uint16_t> grey);
/// In colour; alpha is left out.
[[nodiscard]] Result<std::string> encode_png(const Image& image);

}  // namespace docent::pictures
