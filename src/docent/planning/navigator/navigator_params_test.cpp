#include "docent/planning/navigator/navigator_params.h"

#include <gtest/gtest.h>

namespace docent::planning::navigator_params_test {
namespace {

TEST(NavigatorParams, NamesTheFaultOfEachPart) {
  EXPECT_TRUE(NavigatorParams{}.validate().has_value());
  NavigatorParams params;
  params.goal_tolerance = -0.1;
  EXPECT_EQ(params.validate().error().message, "goal_tolerance must be >= 0");
  params = {};
  params.pursuit.horizon = 0.0;
  EXPECT_EQ(params.validate().error().message, "horizon must be > 0");
  params = {};
  params.tell_apart.longest_way = -1.0;
  EXPECT_FALSE(params.validate().has_value());
  params = {};
  params.route.coarsening = 0;
  EXPECT_FALSE(params.validate().has_value());
  params = {};
  params.coastal.levels = 1;
  ASSERT_FALSE(params.validate().has_value());
  EXPECT_EQ(params.validate().error().message.rfind("coastal.", 0), 0U);
}

}  // namespace
}  // namespace docent::planning::navigator_params_test
