#include "docent/localization/expected_ranges/agreement.h"

#include <gtest/gtest.h>

#include <vector>

#include "docent/localization/markov/testing.h"

namespace docent::localization::agreement_test {
namespace {

TEST(Agreement, NothingUpToSomeRangeAgreesWithAWallBeyondAndSaysNothingOfANearerOne) {
  const testing::Room room;
  const std::vector<LikelyState> here{{0, 0, 1.0F}};
  const ExpectedRanges expected{here, room.table, room.space.headings(), false};
  int walls = 0;
  for (int direction = 0; direction < room.space.headings(); ++direction) {
    const int bin = room.table.row(0)[static_cast<std::size_t>(direction)];
    if (bin >= sensor_models::kNoReturn) continue;
    ++walls;
    const double wall = room.model.centre(bin);
    const auto agrees = [&](int measured) {
      const Agreement found = agreement(expected, room.model, direction, measured, 0.99);
      EXPECT_EQ(found.shorter + found.longer, 0.0);
      return found.agrees;
    };
    if (wall > 0.2) {
      EXPECT_EQ(agrees(room.model.nothing_up_to(std::max(wall - 0.3, 0.05))), 1.0) << wall;
    }
    EXPECT_EQ(agrees(room.model.nothing_up_to(wall + 0.3)), 0.0) << "glass and dark things give no return";
    EXPECT_EQ(agrees(sensor_models::kNoReturn), 0.0);
  }
  EXPECT_GT(walls, 20);
}

}  // namespace
}  // namespace docent::localization::agreement_test
