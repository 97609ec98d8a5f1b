#include "docent/interaction/head/head_control.h"

#include <gtest/gtest.h>

#include <vector>

namespace docent::interaction {
namespace {

class HeadControlTest : public testing::Test {
 protected:
  HeadShown step(double duration_s = 0.1) {
    HeadShown shown;
    for (double passed = 0.0; passed < duration_s - 1e-9; passed += 0.1) {
      now_ = now_ + seconds(0.1);
      shown = head_.step({odom_from_base_, map_from_base_, people_}, now_);
    }
    return shown;
  }
  void visit(TaskStatus status, std::optional<LookFor> look = std::nullopt) {
    head_.task({"t1", TaskKind::visit, Point2{0.0, 5.0}, std::nullopt, std::nullopt});
    head_.task_state({"t1", status, look});
  }

  Time now_ = time_from_seconds(100.0);
  std::optional<Pose2> odom_from_base_ = Pose2{};
  std::optional<Pose2> map_from_base_ = Pose2{};
  std::vector<SeenPerson> people_;
  HeadControl head_{{}, Rng{1}};
};

TEST_F(HeadControlTest, WithNothingToDoItIsHappyAndLooksStraightOn) {
  const HeadShown shown = step(1.0);
  EXPECT_EQ(shown.mood, Mood::happy);
  EXPECT_EQ(shown.pan.position, 0.0);
  EXPECT_FALSE(shown.is_speaking);
}

TEST_F(HeadControlTest, LooksAtTheExhibitOnItsWayWhereItKnowsItsPlace) {
  visit(TaskStatus::driving);
  HeadShown shown = step(3.0);
  EXPECT_EQ(shown.at, LookAt::goal);
  EXPECT_NEAR(shown.pan.position, 1.57, 0.05) << "to the left";
  map_from_base_.reset();
  shown = step();
  EXPECT_NE(shown.at, LookAt::goal);
}

TEST_F(HeadControlTest, ATaskThatIsOverOrAnothersReportCountsNoMore) {
  visit(TaskStatus::driving, LookFor::nobody);
  EXPECT_EQ(step().at, LookAt::none);
  head_.task_state({"t0", TaskStatus::driving, LookFor::place});
  EXPECT_NE(step().at, LookAt::goal) << "nobody knows how this one goes";
}

TEST_F(HeadControlTest, LooksAtWhoeverBlocksItAndGetsAngryUntilTheyAreGone) {
  people_ = {{7, {1.0, 0.0}, {}}};
  for (int i = 0; i < 60; ++i) {
    head_.want(Angle{}, now_);
    head_.block(now_);
    step(0.5);
  }
  HeadShown shown = step();
  EXPECT_EQ(shown.at, LookAt::person);
  EXPECT_EQ(shown.mood, Mood::angry);
  EXPECT_LT(shown.valence, -0.5);
  head_.unblock(now_);
  shown = step(30.0);
  EXPECT_EQ(shown.mood, Mood::happy);
}

TEST_F(HeadControlTest, ABlockageIsForgottenAfterASecond) {
  head_.want(Angle::radians(1.0), now_);
  head_.block(now_);
  EXPECT_EQ(step().at, LookAt::way);
  head_.want(Angle::radians(1.0), now_);
  EXPECT_NE(step(1.2).at, LookAt::way);
}

TEST_F(HeadControlTest, AWantedHeadingIsSeenFromTheRobotAndGrowsOld) {
  odom_from_base_ = Pose2{0.0, 0.0, Angle::radians(0.4)};
  visit(TaskStatus::driving, LookFor::way);
  for (int i = 0; i < 30; ++i) {
    head_.want(Angle::radians(1.0), now_);
    step();
  }
  const HeadShown shown = step();
  EXPECT_EQ(shown.at, LookAt::way);
  EXPECT_NEAR(shown.pan.position, 0.6, 0.05);
  EXPECT_NE(step(1.5).at, LookAt::way) << "whoever is silent may be dead";
  head_.want(Angle::radians(1.0), now_);
  EXPECT_EQ(step().at, LookAt::way);
  odom_from_base_.reset();
  EXPECT_NE(step().at, LookAt::way);
  odom_from_base_ = Pose2{};
  head_.want(std::nullopt, now_);
  EXPECT_NE(step().at, LookAt::way);
}

TEST_F(HeadControlTest, WearsTheFaceThatAttractsPeopleWhileNobodyBlocksIt) {
  head_.task({"m1", TaskKind::mingle, std::nullopt, GazeStrategy::ahead, Mood::sad});
  EXPECT_EQ(step().mood, Mood::happy) << "not before it has begun";
  head_.task_state({"m1", TaskStatus::driving, std::nullopt});
  EXPECT_EQ(step().mood, Mood::sad);
  head_.block(now_);
  EXPECT_NE(step().mood, Mood::sad);
  head_.unblock(now_);
  head_.task_state({"m1", TaskStatus::done, std::nullopt});
  EXPECT_NE(step().mood, Mood::sad);
}

TEST_F(HeadControlTest, TheMouthMovesWhileALineLastsAndClosesWithoutWord) {
  head_.speech(true, now_, 2.0);
  EXPECT_TRUE(step(2.9).is_speaking);
  EXPECT_FALSE(step(0.3).is_speaking);
  head_.speech(true, now_, 2.0);
  EXPECT_TRUE(step().is_speaking);
  head_.speech(false, now_, 2.0);
  EXPECT_FALSE(step().is_speaking);
}

}  // namespace
}  // namespace docent::interaction
