#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "docent/collision_avoidance/avoider/avoider.h"
#include "docent/collision_avoidance/avoider/rehearsal_for_test.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::collision_avoidance::hand_steering_test {
namespace {

Rehearsal in_a_hall() {
  Rehearsal world;
  world.box(-6, -6, 12, 6);
  world.run(0.5);  // its sensors have spoken
  return world;
}

TEST(HandSteering, DrivesTurnsAndGoesBack) {
  Rehearsal world = in_a_hall();
  world.hand = HandSteering{true, 0.5, 0.0};
  world.run(6.0);
  EXPECT_NEAR(world.velocity.linear, 0.35, 0.05);
  EXPECT_EQ(world.decision.reason, to_text(ReasonWord::steered_by_hand));
  EXPECT_GT(world.map_from_base.x, 1.0);
  world.hand = HandSteering{true, 0.0, 1.0};
  world.run(2.0);
  EXPECT_GT(world.velocity.angular, 0.2);
  EXPECT_LT(std::abs(world.velocity.linear), 0.05);
  world.hand = HandSteering{true, -1.0, 0.0};
  world.run(3.0);
  EXPECT_LT(world.velocity.linear, -0.05);
}

TEST(HandSteering, NeverDrivesIntoAnything) {
  Rehearsal world;
  world.box(-3, -3, 5, 3);
  world.hazards = sides({{2.5, -1}, {3.5, -1}, {3.5, 1}, {2.5, 1}});
  world.run(0.5);
  for (const auto& [forward, turn] : {std::pair{1.0, 0.0}, {1.0, 0.6}, {-1.0, 0.0}, {1.0, -1.0}, {1.0, 0.0}}) {
    world.hand = HandSteering{true, forward, turn};
    world.run(15.0);
  }
  EXPECT_GT(world.driven, 3.0);
  EXPECT_GT(world.least_wall, 0.02);
}

TEST(HandSteering, LeadsTheRobotOutOfAZoneByTheNearestEdgeAndNoOtherWay) {
  for (const double heading : {0.0, 90.0}) {
    Rehearsal world = in_a_hall();
    const Polygon zone{{-1.4, -1.2}, {0.8, -1.2}, {0.8, 1.2}, {-1.4, 1.2}};
    world.hazards = sides(zone);
    world.map_from_base.theta = Angle::degrees(heading);
    world.remeasure = [&](VirtualSweep& sweep) {  // as VirtualMeasurements has it: the right edge is the nearest
      const Point2 at = world.map_from_base.position();
      if (!contains(zone, at)) return;
      for (std::size_t i = 0; i < sweep.ranges.size(); ++i) {
        const double bearing = sweep.first_bearing + static_cast<double>(i) * sweep.bearing_step;
        const Angle in_map = world.map_from_base.theta + Angle::radians(bearing);
        sweep.ranges[i] = std::abs(in_map.degrees()) <= 120.0 ? static_cast<float>(sweep.max_range) : 0.05F;
      }
    };
    world.run(0.5);
    world.hand = HandSteering{true, 0.5, 0.0};
    world.run(12.0);
    if (heading == 0.0) {
      EXPECT_GT(world.map_from_base.x, 1.2) << world.decision.reason;
    } else {
      EXPECT_LT(world.map_from_base.y, 0.1) << "towards the middle of a side farther away";
    }
  }
}

TEST(HandSteering, AHandThatLetsGoOrFallsSilentStopsTheRobot) {
  for (const bool falls_silent : {true, false}) {
    Rehearsal world = in_a_hall();
    world.hand = HandSteering{true, 1.0, 0.0};
    world.run(3.0);
    ASSERT_GT(world.velocity.linear, 0.5);
    if (falls_silent) {
      world.hand.reset();
    } else {
      world.hand->is_pressed = false;
    }
    // Half a second of patience at most, a scan, and the way to brake.
    world.run(falls_silent ? 0.5 + 0.15 : 0.15 + 0.1);
    EXPECT_EQ(world.decision.command.linear, 0.0) << falls_silent;
    world.run(1.5);
    EXPECT_LT(std::abs(world.velocity.linear), 0.02);
  }
}

TEST(HandSteering, TheRobotWaitsAWhileAndGoesItsOwnWayAgain) {
  Rehearsal world = in_a_hall();
  world.drive_to({{8, 0}});
  world.hand = HandSteering{false, 0.0, 0.0};
  world.run(5.0);
  EXPECT_LT(world.driven, 0.05) << "the operator holds it";
  world.hand.reset();
  world.run(3.0);
  EXPECT_LT(world.driven, 0.05);
  world.run(4.0);
  EXPECT_GT(world.driven, 0.5);
}

TEST(HandSteering, TheStopButtonStopsWhateverIsWanted) {
  Rehearsal world = in_a_hall();
  world.drive_to({{8, 0}});
  world.run(4.0);
  ASSERT_GT(world.velocity.linear, 0.5);
  world.avoider.stop_by_hand(true);
  world.run(0.15);
  EXPECT_EQ(world.decision.command.linear, 0.0);
  EXPECT_EQ(world.decision.reason, to_text(ReasonWord::stopped_by_hand));
  world.run(2.0);
  const double driven = world.driven;
  world.hand = HandSteering{true, 1.0, 0.0};
  world.run(3.0);
  EXPECT_EQ(world.driven, driven) << "nor does the hand move it";
  world.hand.reset();
  world.avoider.stop_by_hand(false);
  world.run(8.0);
  EXPECT_GT(world.driven, driven + 0.5);
}

TEST(DockDrive, ComesUpToAThingAndTouchesNothing) {
  Rehearsal world;
  world.box(-3, -3, 1.5, 3);  // a wall ahead
  world.run(0.5);
  double nearest = 9.0;
  for (int i = 0; i < 400; ++i) {
    world.avoider.dock_with(world.now, {0.08, 0.0});
    world.run(0.05);
    nearest = std::min(nearest, world.least_wall);
  }
  EXPECT_LT(nearest, 0.1);
  EXPECT_GT(nearest, 0.015);
  const double stood = world.driven;
  world.run(2.0);  // nobody says anything any more
  EXPECT_NEAR(world.driven, stood, 0.02);
}

TEST(DockDrive, FastItKeepsTheMargins) {
  Rehearsal world;
  world.box(-3, -3, 1.5, 3);
  world.run(0.5);
  for (int i = 0; i < 400; ++i) {
    world.avoider.dock_with(world.now, {0.3, 0.0});
    world.run(0.05);
  }
  EXPECT_GT(world.least_wall, 0.05);
}

}  // namespace
}  // namespace docent::collision_avoidance::hand_steering_test
