#pragma once

#include <string>
#include <string_view>

#include "docent/base/result.h"

namespace docent::telepresence {

/// A picture that somebody sends for an exhibit, drawn anew: what is not picture (where it was taken, say, or what
/// another program might take for something else) is left behind. Error: why not, a sentence for whoever sent it.
/// @param base64  a JPEG file (RFC 4648, with padding), of 16 to 2560 pixels a side @returns a JPEG file. O(pixels)
[[nodiscard]] Result<std::string> exhibit_picture(std::string_view base64);

}  // namespace docent::telepresence
