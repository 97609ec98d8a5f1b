#include "docent/vision/regions/sites.h"

#include <algorithm>
#include <cstdint>

#include "docent/base/check.h"

namespace docent::vision {

Sites sites_of(const pictures::Image& picture, int block) {
  DOCENT_CHECK(block >= 1 && block <= std::min(picture.width(), picture.height()));
  Sites sites{picture.width() / block, picture.height() / block, block, {}};
  sites.cells.reserve(static_cast<std::size_t>(sites.columns) * static_cast<std::size_t>(sites.rows));
  const auto width = static_cast<std::size_t>(picture.width());
  const float share = 1.0F / static_cast<float>(block * block);
  for (int row = 0; row < sites.rows; ++row) {
    for (int column = 0; column < sites.columns; ++column) {
      std::uint32_t red = 0, green = 0, blue = 0;
      for (int y = row * block; y < (row + 1) * block; ++y) {
        const std::uint8_t* pixel =
            &picture.bytes()[4 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(column * block))];
        for (int x = 0; x < block; ++x, pixel += 4) {
          red += pixel[0];
          green += pixel[1];
          blue += pixel[2];
        }
      }
      const float r = share * static_cast<float>(red);
      const float g = share * static_cast<float>(green);
      const float b = share * static_cast<float>(blue);
      sites.cells.push_back({(r + g + b) / 3.0F, r - g, 0.5F * (r + g) - b});
    }
  }
  return sites;
}

}  // namespace docent::vision
