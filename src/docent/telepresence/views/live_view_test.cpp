#include "docent/telepresence/views/live_view.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {

using Json = nlohmann::json;

class LiveViewTest : public testing::Test {
 protected:
  Json live() { return Json::parse(view_.live(now_)); }
  void drive_to(double x) {
    nav_msgs::Odometry odometry;
    odometry.header.stamp = to_message(now_);
    odometry.pose.pose = to_message(Pose2{x, 0, Angle{}});
    view_.see(odometry);
  }
  void believe(double x, double y) {
    docent_msgs::Belief belief;
    belief.header.stamp = to_message(now_);
    belief.localized = true;
    belief.hypotheses.resize(1);
    belief.hypotheses[0].x = x;
    belief.hypotheses[0].y = y;
    belief.hypotheses[0].mass = 1.0;
    belief.cells = {{static_cast<float>(x), static_cast<float>(y), 0.0F, 1.0F}};
    belief.odom_pose = to_message(Pose2{});
    view_.see(belief);
  }
  /// Three readings, straight ahead and to both sides; 2 m all.
  sensor_msgs::LaserScan scan() {
    sensor_msgs::LaserScan scan;
    scan.header.stamp = to_message(now_);
    scan.angle_min = -1.5707964F;
    scan.angle_increment = 1.5707964F;
    scan.range_max = 10.0F;
    scan.ranges = {2.0F, 2.0F, 2.0F};
    return scan;
  }

  Time now_ = time_from_seconds(100.0);
  LiveView view_{{Pose2{0.2, 0.0, Angle{}}}, 1};
};

TEST_F(LiveViewTest, ThePoseIsCarriedOnByOdometry) {
  EXPECT_TRUE(live()["pose"].is_null());
  EXPECT_FALSE(view_.map_from_base(now_));
  drive_to(0.0);
  believe(5.0, 4.0);
  now_ = now_ + seconds(0.5);
  drive_to(1.0);
  EXPECT_EQ(live()["pose"], Json({6.0, 4.0, 0.0}));
  EXPECT_EQ(Json::parse(view_.pose(now_))["pose"], Json({6.0, 4.0, 0.0}));
  ASSERT_TRUE(view_.map_from_base(now_));
  EXPECT_DOUBLE_EQ(view_.map_from_base(now_)->x, 6.0);
}

TEST_F(LiveViewTest, AScanIsShownWhereItsScannerIsAndForASecondOnly) {
  const std::size_t empty = view_.live(now_).size();
  view_.see_scan(0, scan());
  const Json in_robot = live();
  EXPECT_GT(view_.live(now_).size(), empty);
  drive_to(0.0);
  believe(5.0, 4.0);
  EXPECT_NE(live(), in_robot) << "now in the map";
  now_ = now_ + seconds(1.1);
  drive_to(0.0);
  const Json old = live();
  view_.see_scan(0, {});
  EXPECT_EQ(live(), old);
}

TEST_F(LiveViewTest, PeopleAndWindowsThatAreOldAreNotShown) {
  docent_msgs::People people;
  people.header.stamp = to_message(now_);
  people.people = {{7, 1.0F, 2.0F, 0.0F, 0.0F}};
  view_.see(people);
  EXPECT_EQ(live()["people"].size(), 1U);
  EXPECT_EQ(view_.people().people.size(), 1U);
  now_ = now_ + seconds(1.1);
  EXPECT_EQ(live()["people"].size(), 0U);
}

TEST_F(LiveViewTest, BeliefAndWayAreShownOnceUntilTheyAreNew) {
  EXPECT_FALSE(view_.belief());
  EXPECT_FALSE(view_.path());
  believe(5.0, 4.0);
  EXPECT_TRUE(view_.belief());
  EXPECT_FALSE(view_.belief());
  view_.see(nav_msgs::Path{});
  EXPECT_TRUE(view_.path());
  EXPECT_FALSE(view_.path());
  view_.see(docent_msgs::GoalState{});
  EXPECT_TRUE(view_.path());
}

TEST_F(LiveViewTest, TheChargeIsShownOnceItIsKnown) {
  EXPECT_TRUE(live()["battery"].is_null());
  sensor_msgs::BatteryState battery;
  battery.percentage = 0.5F;
  view_.see(battery);
  EXPECT_EQ(live()["battery"], 0.5);
}

}  // namespace
}  // namespace docent::telepresence
