#include "docent/collision_avoidance/avoider/input_watches.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "docent/collision_avoidance/avoider/avoider.h"
#include "docent/collision_avoidance/avoider/rehearsal_for_test.h"

namespace docent::collision_avoidance::input_watches_test {
namespace {

TEST(InputWatches, StandsWhenTheInfraredRingFallsSilent) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  for (int i = 0; i < 25; ++i) {
    world.avoider.add_infrared(world.now, 0, {world.now, {0.25, 0.0, {}}, 0.09, 0.8, 0.8});
    world.run(0.2);
  }
  EXPECT_GT(world.velocity.linear, 0.5);
  world.run(2.0);
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_EQ(world.avoider.fault(world.now), "no fresh infrared reading");
}

TEST(InputWatches, StandsWhenAnythingItNeedsFallsSilentAndGoesOnWhenItReturns) {
  const std::vector<std::pair<bool Rehearsal::*, const char*>> parts{{&Rehearsal::front_works, "front laser"},
                                                                     {&Rehearsal::rear_works, "rear laser"},
                                                                     {&Rehearsal::odometry_works, "odometry"},
                                                                     {&Rehearsal::virtual_works, "virtual"},
                                                                     {&Rehearsal::target_works, "target"}};
  for (const auto& [part, name] : parts) {
    Rehearsal world;
    world.box(-3, -5, 40, 5);
    world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
    world.run(5);
    ASSERT_GT(world.velocity.linear, 0.5);
    world.*part = false;
    world.run(3.0);
    EXPECT_EQ(world.velocity.linear, 0.0) << name;
    EXPECT_NE(world.decision.reason.find(name), std::string::npos) << world.decision.reason;
    world.*part = true;
    world.run(5);
    EXPECT_GT(world.velocity.linear, 0.5) << name;
  }
}

TEST(InputWatches, DoesNotTrustAFrozenLaser) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  world.front_repeats = true;
  world.run(1.5);
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_EQ(world.decision.reason, "the front laser is frozen");
  world.front_repeats = false;
  world.run(4);
  EXPECT_GT(world.velocity.linear, 0.5);
}

TEST(InputWatches, CreepsAndSaysWhyWhenHalfOfALasersReadingsAreGone) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  ASSERT_GT(world.velocity.linear, 0.5);
  world.front_missing = 0.5;
  world.run(1.5);
  for (int i = 0; i < 40; ++i) {
    world.run(0.25);
    EXPECT_LT(world.velocity.linear, ComplaintParams{}.crippled_speed + 0.01);
    EXPECT_EQ(world.decision.reason, "the front laser gives too few readings");
  }
}

TEST(InputWatches, StandsBeforeAWallThatALyingLaserDoesNotShow) {
  const std::vector<std::pair<std::string, std::function<void(SensorSweep&)>>> lies{
      {"wrong units",
       [](SensorSweep& sweep) {
         for (float& range : sweep.ranges) range *= 1000.0F;
       }},
      {"ends anywhere", [](SensorSweep& sweep) { sweep.ranges.assign(180, std::numeric_limits<float>::infinity()); }},
      {"2.0 times too long", [](SensorSweep& sweep) {
         for (float& range : sweep.ranges) range *= 2.0F;
         sweep.max_range *= 2.0;
       }}};
  for (const auto& [words, lie] : lies) {
    for (const double begins : {0.0, 1.0}) {
      Rehearsal world;
      world.box(-3.0, -2.0, 2.1 + begins, 2.0);
      world.drive_to({{6.0, 0.0}});
      if (begins == 0.0) world.map_from_base.x = 0.8;  // a wall 0.9 m ahead, and a metre of body
      world.run(begins);
      world.spoil = lie;
      world.run(1.0);
      const std::string said = world.decision.reason;
      world.run(9.0);
      EXPECT_GT(world.least_wall, 0.0) << words << " from " << begins;
      // What is twice as far from the start shows when it moves.
      const std::string all = said + world.decision.reason;
      EXPECT_NE(all.find("front laser"), std::string::npos) << all;
      EXPECT_NE(all.find(words), std::string::npos) << all;
    }
  }
}

TEST(InputWatches, ADoubtfulPositionSlowsIt) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  const std::vector<BelievedPose> modes{{{}, 0.5}, {{9, 9, {}}, 0.5}};
  for (int i = 0; i < 2; ++i) world.avoider.add_belief({modes, modes, 0.02, true});
  world.run(1.5);
  EXPECT_LT(world.velocity.linear, ComplaintParams{}.crippled_speed + 0.01);
  EXPECT_EQ(world.decision.reason, "it may be in two places");
  EXPECT_FALSE(world.avoider.complaint_of_inputs(world.now)) << "no sensor is to blame";
}

TEST(InputWatches, CrippledItTakesEverythingForWell) {
  AvoiderParams params = Rehearsal::without_sonar();
  params.watches = false;
  Rehearsal world{1, params};
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  world.front_works = false;
  world.run(3);
  EXPECT_GT(world.velocity.linear, 0.5);
}

TEST(InputWatches, StandsWhenTheTactileRingThatWasThereFallsSilent) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  for (int i = 0; i < 25; ++i) {
    world.run(0.2);
    world.avoider.add_tactile(world.now, world.now, {});
  }
  ASSERT_GT(world.velocity.linear, 0.5);
  world.run(3.0);
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_EQ(world.decision.reason, "the tactile ring is silent");
  for (int i = 0; i < 25; ++i) {
    world.run(0.2);
    world.avoider.add_tactile(world.now, world.now, {});
  }
  EXPECT_GT(world.velocity.linear, 0.5);
}

TEST(InputWatches, StandsWhenTwoSonarsSideBySideFallSilentButNotForOne) {
  AvoiderParams params;
  params.needs_sonar = true;
  Rehearsal world{1, params};
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  const auto run = [&](double duration, auto is_silent) {
    for (double t = 0.0; t < duration; t += 0.4) {
      for (std::size_t i = 0; i < 24; ++i) {
        const Pose2 mount{0.0, 0.0, Angle::degrees(15.0 * static_cast<double>(i))};
        if (!is_silent(i)) world.avoider.add_sonar(world.now, i, {world.now, mount, 0.26, 5.0, 5.0});
      }
      world.run(0.4);
    }
  };
  run(4.0, [](std::size_t) { return false; });
  run(4.0, [](std::size_t i) { return i == 7 || i == 23; });
  EXPECT_GT(world.velocity.linear, 0.5);
  run(4.0, [](std::size_t i) { return i == 0 || i == 23; });
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_EQ(world.decision.reason, "no fresh sonar reading of number 23 and the next");
}

TEST(InputWatches, VirtualMeasurementsThatAreNoNumbersAreNone) {
  Rehearsal world;
  world.box(-3, -5, 40, 5);
  world.drive_to({{2, 0}, {4, 0}, {8, 0}, {30, 0}});
  world.run(5);
  ASSERT_GT(world.velocity.linear, 0.5);
  world.virtual_is_nan = true;
  world.run(3);
  EXPECT_EQ(world.velocity.linear, 0.0);
  EXPECT_NE(world.decision.reason.find("virtual"), std::string::npos);
}

}  // namespace
}  // namespace docent::collision_avoidance::input_watches_test
