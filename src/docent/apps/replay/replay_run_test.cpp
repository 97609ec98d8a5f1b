#include "docent/apps/replay/replay_run.h"

#include <gtest/gtest.h>

namespace docent::apps::replay_command {
namespace {

TEST(NamesOfBoth, HoldsEachNameOnceInTheOrderOfItsFirstUse) {
  EXPECT_EQ(names_of_both("", ""), "");
  EXPECT_EQ(names_of_both("dead_reckoning", ""), "dead_reckoning");
  EXPECT_EQ(names_of_both("", "dead_reckoning"), "dead_reckoning");
  EXPECT_EQ(names_of_both("without_ladder, dead_reckoning", "dead_reckoning, best_pose_only"),
            "without_ladder, dead_reckoning, best_pose_only");
  EXPECT_EQ(names_of_both("without_ladder", "without_ladders"), "without_ladder, without_ladders");
}

}  // namespace
}  // namespace docent::apps::replay_command
