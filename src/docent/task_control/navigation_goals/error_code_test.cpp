#include "docent/task_control/navigation_goals/error_code.h"

#include <gtest/gtest.h>

namespace docent::task_control {
namespace {

TEST(ErrorCode, IsTheOneOfNav2ThatComesNearest) {
  EXPECT_EQ(error_code_of(""), 0);
  EXPECT_EQ(error_code_of("not_on_free_floor"), 206) << "ComputePathToPose.GOAL_OCCUPIED";
  EXPECT_EQ(error_code_of("no_way"), 208) << "ComputePathToPose.NO_VALID_PATH";
  EXPECT_EQ(error_code_of("not_reached 3.00,4.00"), 105) << "FollowPath.FAILED_TO_MAKE_PROGRESS, whatever it is about";
  EXPECT_EQ(error_code_of("robot_silent"), 9003) << "NavigateToPose.TIMEOUT";
  EXPECT_EQ(error_code_of("too_many_wait"), 9000) << "NavigateToPose.UNKNOWN";
  EXPECT_EQ(error_code_of("a word of tomorrow"), 9000);
}

}  // namespace
}  // namespace docent::task_control
