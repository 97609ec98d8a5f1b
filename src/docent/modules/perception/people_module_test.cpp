#include "docent/modules/perception/people_module.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/geometry/polygon.h"
#include "docent/modules/shared/module_bench.h"

namespace docent::modules::people_module_test {
namespace {

constexpr std::uint8_t kOfTheMap = 1;
constexpr std::uint8_t kSurelyNotTheMap = 3;

/// A robot that stands at (1, 0) of odometry's frame, looks north there, and meets a person in a hall without walls.
class PeopleModule : public ModuleBench {
 protected:
  PeopleModule() : ModuleBench{"people", make_people} {
    keep(topics::kPeople, in_map, map_count);
    keep(topics::kPeopleInOdom, in_odom, odom_count);
  }

  /// What localize says of a sweep with a person there [m], base_link.
  [[nodiscard]] docent_msgs::PersonBeams beams_with(Point2 person) const {
    docent_msgs::PersonBeams beams;
    beams.header = {to_message(hub.now()), "base_link"};
    beams.localized = localized;
    beams.map_from_base = {map_from_base.x, map_from_base.y, map_from_base.theta.radians()};
    beams.odom_from_base = {odom_from_base.x, odom_from_base.y, odom_from_base.theta.radians()};
    for (int i = -180; i < 180; ++i) {
      const Angle bearing = Angle::degrees(i);
      const auto hit = ray_distance({}, unit(bearing), person, 0.22);
      beams.bearings.push_back(static_cast<float>(bearing.radians()));
      beams.ranges.push_back(static_cast<float>(hit.value_or(9.0)));
      beams.origins.push_back(hit ? origin : kOfTheMap);
    }
    return beams;
  }
  /// Ten sweeps a second; the person walks along the robot's x axis.
  void watch(Point2 from, double speed, double duration) {
    for (int i = 0; i < static_cast<int>(std::lround(duration * 10.0)); ++i) {
      publisher.publish(beams_with({from.x + 0.1 * i * speed, from.y}));
      run(0.1);
    }
  }

  Pose2 map_from_base{5.0, 6.0, Angle::degrees(180.0)};
  Pose2 odom_from_base{1.0, 0.0, Angle::degrees(90.0)};
  bool localized = true;
  std::uint8_t origin = kSurelyNotTheMap;
  transport::Publisher<docent_msgs::PersonBeams> publisher = world->publisher(topics::kPersonBeams);
  docent_msgs::People in_map, in_odom;
  int map_count = 0, odom_count = 0;
};

TEST_F(PeopleModule, TellsWhereAPersonIsAndHowTheyWalkInBothFrames) {
  start();
  watch({3.0, 0.5}, -0.6, 2.0);
  ASSERT_EQ(in_odom.people.size(), 1U);
  ASSERT_EQ(in_map.people.size(), 1U);
  const double ahead = 3.0 - 0.6 * 1.9;
  EXPECT_EQ(in_odom.header.frame_id, "odom");
  EXPECT_NEAR(static_cast<double>(in_odom.people[0].x), 1.0 - 0.5, 0.15);
  EXPECT_NEAR(static_cast<double>(in_odom.people[0].y), ahead, 0.15);
  EXPECT_NEAR(static_cast<double>(in_odom.people[0].vx), 0.0, 0.15);
  EXPECT_NEAR(static_cast<double>(in_odom.people[0].vy), -0.6, 0.15);
  EXPECT_EQ(in_map.header.frame_id, "map");
  EXPECT_NEAR(static_cast<double>(in_map.people[0].x), 5.0 - ahead, 0.15);
  EXPECT_NEAR(static_cast<double>(in_map.people[0].y), 6.0 - 0.5, 0.15);
  EXPECT_NEAR(static_cast<double>(in_map.people[0].vx), 0.6, 0.15);
  EXPECT_NEAR(static_cast<double>(in_map.people[0].vy), 0.0, 0.15);
  EXPECT_EQ(in_map.people[0].id, in_odom.people[0].id);
  EXPECT_EQ(in_map.groups.size(), 1U);
  EXPECT_EQ(in_odom.frame_from_base[0], 1.0);
  EXPECT_EQ(in_map.frame_from_base[0], 5.0);
  EXPECT_EQ(from_message(in_map.header.stamp), time_from_seconds(1.9)) << "the stamp of the sweep";
  EXPECT_EQ(map_count, 20);
  EXPECT_EQ(odom_count, 20);
}

TEST_F(PeopleModule, ALostRobotFollowsInOdometryAloneWhomItKnew) {
  start();
  watch({3.0, 0.0}, -0.3, 2.0);
  const auto id = in_odom.people.at(0).id;
  localized = false;
  map_from_base = {90.0, 90.0, Angle{}};  // a guess
  watch({2.4, 0.0}, -0.3, 1.0);
  EXPECT_FALSE(in_map.localized);
  EXPECT_TRUE(in_map.people.empty());
  EXPECT_TRUE(in_map.groups.empty());
  ASSERT_EQ(in_odom.people.size(), 1U);
  EXPECT_EQ(in_odom.people[0].id, id);
  EXPECT_NEAR(static_cast<double>(in_odom.people[0].y), 2.4 - 0.27, 0.15);
}

TEST_F(PeopleModule, AJumpOfThePoseInTheMapMovesNobodyInOdometry) {
  start();
  watch({3.0, 0.0}, -0.3, 2.0);
  const auto before = in_odom.people.at(0);
  map_from_base = {6.0, 6.0, Angle::degrees(180.0)};
  watch({2.4, 0.0}, -0.3, 0.1);
  ASSERT_EQ(in_odom.people.size(), 1U);
  EXPECT_EQ(in_odom.people[0].id, before.id);
  EXPECT_NEAR(static_cast<double>(in_odom.people[0].vy), -0.3, 0.15);
  EXPECT_NEAR(static_cast<double>(in_map.people.at(0).x), 6.0 - 2.4, 0.15);
}

TEST_F(PeopleModule, AnOriginThatItDoesNotKnowIsNoPerson) {
  start();
  origin = 77;
  watch({3.0, 0.0}, 0.0, 3.0);
  EXPECT_GT(odom_count, 0);
  EXPECT_TRUE(in_odom.people.empty());
}

TEST_F(PeopleModule, SaysSoAndPublishesNothingWithoutBeams) {
  start();
  watch({3.0, 0.0}, -0.3, 2.0);
  const int count = odom_count;
  EXPECT_EQ(module->health().state, "ready");
  run(2.1);
  EXPECT_EQ(module->health().reason, "no docent/person_beams");
  EXPECT_EQ(odom_count, count) << "nothing is made of nothing";
  start();
  watch({3.0, 0.0}, -0.3, 0.1);
  EXPECT_TRUE(in_odom.people.empty()) << "a new process begins with nobody";
  EXPECT_EQ(module->health().state, "ready");
}

}  // namespace
}  // namespace docent::modules::people_module_test
