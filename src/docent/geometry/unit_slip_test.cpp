#include "docent/geometry/unit_slip.h"

#include <gtest/gtest.h>

namespace docent {
namespace {

TEST(UnitSlip, SharesOfATurnInRadiansAreToldFromDegrees) {
  for (const double slip : {3.14159, -3.1416, 1.5708, -1.57, 0.785, 2.356, 6.2832, 1.0472})
    EXPECT_TRUE(looks_like_radians(slip)) << slip;
  for (const double right : {0.0, 3.0, -2.0, 180.0, -90.0, 0.5, 1.2, 2.5, 5.8, 10.3, 45.0})
    EXPECT_FALSE(looks_like_radians(right)) << right;
}

}  // namespace
}  // namespace docent
