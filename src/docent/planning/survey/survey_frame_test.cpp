#include "docent/planning/survey/survey_frame.h"

#include <gtest/gtest.h>

namespace docent::planning::survey_frame_test {
namespace {

const Pose2 kHome{10.0, 5.0, Angle::degrees(90.0)};

localization::LocalizerCheckpoint checkpoint(const Pose2& odom_from_robot, const Pose2& map_from_robot) {
  return {"", Time{}, odom_from_robot, {{map_from_robot, {}, 1.0}}};
}

void expect_near(const Pose2& pose, const Pose2& wanted) {
  EXPECT_NEAR(pose.x, wanted.x, 1e-9);
  EXPECT_NEAR(pose.y, wanted.y, 1e-9);
  EXPECT_NEAR((pose.theta - wanted.theta).radians(), 0.0, 1e-9);
}

TEST(SurveyFrame, ItBeginsAtHomeWhateverOdometrySays) {
  SurveyFrame frame{kHome};
  EXPECT_FALSE(frame.odom_from_base());
  frame.move(Time{}, {{3.0, 4.0, {}}, {}});
  EXPECT_TRUE(frame.odom_from_base());
  EXPECT_FALSE(frame.map_from_base()) << "nothing was seen yet";
  expect_near(frame.begin_moment({3.0, 4.0, {}}), kHome);
  frame.end_moment(kHome);
  frame.move(time_from_seconds(3.0), {{5.0, 4.0, {}}, {}});
  expect_near(frame.map_from_base().value(), {10.0, 7.0, Angle::degrees(90.0)});
}

TEST(SurveyFrame, TheMapKnowsBetterThanOdometry) {
  SurveyFrame frame{Pose2{}};
  (void)frame.begin_moment({});
  frame.end_moment({});
  frame.move(time_from_seconds(1.0), {{2.0, 0.0, {}}, {}});
  expect_near(frame.begin_moment({2.0, 0.0, {}}), {2.0, 0.0, {}});
  frame.end_moment({2.0, 0.3, {}});
  expect_near(frame.map_from_base().value(), {2.0, 0.3, {}});
  expect_near(frame.begin_moment({4.0, 0.0, {}}), {4.0, 0.0, {}});
  EXPECT_NEAR(frame.way(), 4.0, 1e-9);
}

TEST(SurveyFrame, ItGoesOnInTheFrameThatItHadBefore) {
  SurveyFrame frame{kHome, checkpoint({1.0, 0.0, {}}, {20.0, 8.0, {}})};
  expect_near(frame.begin_moment({1.5, 0.0, {}}), {20.5, 8.0, {}});
}

TEST(SurveyFrame, WhereOdometryBeganAnewItIsBackAtHome) {
  SurveyFrame frame{kHome, checkpoint({30.0, 0.0, {}}, {20.0, 8.0, {}})};
  expect_near(frame.begin_moment({0.0, 0.0, {}}), kHome);
}

TEST(SurveyFrame, LiesElsewhereAndBeginsAnew) {
  SurveyFrame frame{{1.0, 0.0, {}}};
  frame.move(time_from_seconds(1.0), {{}, {}});
  frame.end_moment(frame.begin_moment({}));
  frame.move(time_from_seconds(4.0), {{2.0, 0.0, {}}, {}});
  frame.end_moment(frame.begin_moment({2.0, 0.0, {}}));
  EXPECT_NEAR(frame.map_from_base()->x, 3.0, 1e-12);
  const Pose2 site_from_survey{0.5, 0.25, {}};
  frame.lie(site_from_survey);
  EXPECT_NEAR(frame.map_from_base()->x, 3.5, 1e-12);
  EXPECT_NEAR(frame.map_from_base()->y, 0.25, 1e-12);
  frame.begin_anew(site_from_survey);
  EXPECT_NEAR(frame.map_from_base()->x, 3.5, 1e-12) << "from where odometry has it";
}

TEST(SurveyFrame, AJumpOfTheOdometryIsNoWay) {
  SurveyFrame frame{kHome};
  const Pose2 before{3.0, 4.0, {}};
  for (int i = 0; i < 20; ++i) frame.move(time_from_seconds(0.05 * i), {before, {}});
  frame.end_moment(frame.begin_moment(*frame.odom_from_base()));
  const Pose2 anew{};  // the base began anew
  for (int i = 0; i < 20; ++i) frame.move(time_from_seconds(6.0 + 0.05 * i), {anew, {}});
  expect_near(frame.map_from_base().value(), kHome);
  expect_near(frame.raw_from_odom() * *frame.odom_from_base(), anew);
  expect_near(frame.raw_from_odom(time_from_seconds(0.5)) * *frame.odom_from_base(), before);
  expect_near(frame.odometry().pose_at(time_from_seconds(0.5)), before);
}

}  // namespace
}  // namespace docent::planning::survey_frame_test
