#include "docent/evaluation/run_logs/thing_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

/// A robot at (1, 1) that looks along x, with one laser and one sonar at its centre; a stool 2 m before it stands for
/// three seconds.
class ThingLogTest : public testing::Test {
 protected:
  ThingLogTest() {
    log_.watch({{{2.2, 1.0}, 0.2, 3.0}}, [](std::string_view frame) -> std::optional<Pose2> {
      return frame == "laser_front" || frame == "sonar_00" ? std::optional{Pose2{}} : std::nullopt;
    });
  }

  template <class T>
  void send(const Topic<T>& topic, T message, double at) {
    log_.add(transport::topic_info(topic), time_from_seconds(at), std::make_shared<const T>(std::move(message)));
  }
  void truth(double at, const std::vector<Point2>& people = {}) {
    docent_msgs::TrueState state;
    state.header.stamp = to_message(time_from_seconds(at));
    state.x = state.y = 1.0;
    for (const Point2 place : people) {
      docent_msgs::TruePerson person;
      person.x = static_cast<float>(place.x);
      person.y = static_cast<float>(place.y);
      state.people.push_back(person);
    }
    send(topics::kTrueState, std::move(state), at);
  }
  void put_up(double at) {
    send(topics::kTrueOffer, {{to_message(time_from_seconds(at)), "world"}, "stool", "stool-0"}, at);
  }
  void scan(double at, float range) {
    sensor_msgs::LaserScan scan;
    scan.header = {to_message(time_from_seconds(at)), "laser_front"};
    scan.range_min = 0.05F;
    scan.ranges = {range};
    send(topics::kScanFront, std::move(scan), at);
  }
  void hear(double at, float range) {
    sensor_msgs::Range heard;
    heard.header = {to_message(time_from_seconds(at)), "sonar_00"};
    heard.field_of_view = static_cast<float>(std::numbers::pi / 4.0);
    heard.range = range;
    send(topics::kSonar, heard, at);
  }
  void map(double at, bool blocked) {
    nav_msgs::OccupancyGrid grid;
    grid.info.resolution = 0.2F;
    grid.info.width = grid.info.height = 20;
    grid.data.assign(400, 0);
    if (blocked) grid.data[5 * 20 + 11] = 80;  // [2.2, 2.4] x [1.0, 1.2]
    send(topics::kLiveMap, std::move(grid), at);
  }

  ThingLog log_;
};

TEST_F(ThingLogTest, TellsWhenItWasSeenAndMappedAndGone) {
  truth(10.0);
  scan(10.0, 1.0F);  // nothing is up yet
  put_up(11.0);
  truth(11.5);
  scan(11.5, 0.6F);  // something before it
  scan(11.6, 1.0F);
  truth(11.7);
  hear(11.7, 1.02F);
  map(11.8, false);
  map(12.0, true);
  truth(14.5);
  scan(14.5, 1.0F);  // somebody stands where it was
  scan(14.6, 4.0F);
  truth(14.7);
  hear(14.7, 4.0F);
  map(14.8, true);
  map(15.0, false);
  EXPECT_EQ(log_.rows(),
            "1.00,0,up,0.00\n1.60,0,laser,1.20\n1.70,0,cone,1.20\n2.00,0,mapped,0.00\n4.50,0,down,0.00\n"
            "4.60,0,laser_gone,1.20\n4.70,0,cone_gone,1.20\n5.00,0,unmapped,0.00\n");
}

TEST_F(ThingLogTest, WherePeopleStandTheMapMayBeBlocked) {
  truth(10.0);
  put_up(11.0);
  truth(11.5, {{2.3, 1.2}});
  map(11.6, true);
  EXPECT_EQ(log_.rows(), "1.00,0,up,0.00\n") << "it may be the person";
  truth(14.5, {{2.3, 1.2}});
  map(14.6, true);
  EXPECT_EQ(log_.rows(), "1.00,0,up,0.00\n4.50,0,down,0.00\n4.60,0,unmapped,0.00\n");
}

TEST_F(ThingLogTest, AConeMustLookOverAllOfIt) {
  truth(10.0);
  put_up(11.0);
  truth(14.5);
  hear(14.6, 1.15F);  // beyond its front, before its back
  EXPECT_EQ(log_.rows().find("cone_gone"), std::string::npos);
}

}  // namespace
}  // namespace docent::evaluation
