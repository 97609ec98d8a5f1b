#include "docent/task_control/navigation_goals/request_id.h"

#include <gtest/gtest.h>

namespace docent::task_control {
namespace {

TEST(RequestId, IsAUuidOfVersionSeven) {
  const GoalId goal{0xC0, 1, 2, 3, 4, 5, 6, 7, 8};
  // RFC 9562, 5.7: 48 bits of milliseconds, the version, 12 bits, the variant 10, 62 bits.
  EXPECT_EQ(request_id(Time{1'764'489'600'123'000'000}, goal, 0), "019ad3c6-9c7b-7000-8001-020304050607");
  EXPECT_EQ(request_id(Time{0}, goal, 4095), "00000000-0000-7fff-8001-020304050607");
}

TEST(RequestId, DiffersByGoalAndNumber) {
  EXPECT_NE(request_id({}, {1}, 0), request_id({}, {2}, 0));
  EXPECT_NE(request_id({}, {1}, 0), request_id({}, {1}, 1));
}

}  // namespace
}  // namespace docent::task_control
