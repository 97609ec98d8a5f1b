#include "docent/planning/value_iteration/value_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "docent/grid/clearance.h"

namespace docent::planning {

ValuePicture value_picture(const ValueIteration& values, int side) {
  const GridFrame& fine = values.frame();
  ValuePicture picture{coarse_frame(fine, side), {}};
  std::vector<float> costs(picture.frame.size(), std::numeric_limits<float>::infinity());
  float most = 0.0F;
  for (int row = 0; row < fine.rows; ++row) {
    for (int column = 0; column < fine.columns; ++column) {
      const float value = values.value({column, row});
      if (!std::isfinite(value)) continue;
      float& cost = costs[picture.frame.index({column / side, row / side})];
      cost = std::min(cost, value);
      most = std::max(most, value);
    }
  }
  for (const float cost : costs) {
    const float share = most > 0.0F ? cost / most : 0.0F;
    picture.shares.push_back(std::isfinite(cost) ? static_cast<std::int8_t>(std::lround(100.0F * std::min(share, 1.0F)))
                                                 : std::int8_t{-1});
  }
  return picture;
}

}  // namespace docent::planning
