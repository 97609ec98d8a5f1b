#include "docent/localization/pose_watch/pose_watch.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <numbers>
#include <string>

#include "docent/localization/markov/markov_localizer.h"
#include "docent/localization/markov/testing.h"

namespace docent::localization::pose_watch_test {
namespace {

LocalizerParams coarse() {
  LocalizerParams params;
  params.states.heading_step = 3.0;
  return params;
}

/// A robot that is driven round a room, with one laser that sees all round it.
class PoseWatch : public ::testing::Test {
 protected:
  PoseWatch() { begin(); }
  ~PoseWatch() override { std::filesystem::remove(checkpoint); }

  /// A new process.
  void begin() {
    watch = std::make_unique<localization::PoseWatch>(
        std::make_unique<MarkovLocalizer>(map, localizer, RangeTableCache{}, 1), std::vector<Pose2>{Pose2{}},
        CheckpointKeeper{checkpoint, "room"}, params, now);
  }
  /// A fifth of a second.
  std::optional<localization::PoseWatch::Look> step(bool drives = true) {
    now = now + seconds(0.2);
    if (drives) {
      const bool is_free = caster.clearance((truth * Pose2{0.25, 0.0, {}}).position()) > 0.35F;
      const Pose2 motion = is_free ? Pose2{0.1, 0.0, Angle::degrees(2.0)} : Pose2{0.0, 0.0, Angle::degrees(10.0)};
      truth = truth * motion;
      raw_from_base = raw_from_base * motion;
    }
    watch->move(now, raw_from_base);
    std::vector<float> ranges;
    for (const auto& beam : testing::sweep_at(caster, truth, 10.0).beams)
      ranges.push_back(static_cast<float>(beam.range));
    if (stranger_at > 0.0F) std::fill(ranges.begin() + 175, ranges.begin() + 186, stranger_at);
    watch->see(0, now, {ranges, Angle::degrees(-180.0), Angle::degrees(1.0).radians(), 0.02, 10.0}, now);
    return watch->look(now);
  }
  void find_itself() {
    for (int i = 0; i < 200 && !watch->is_localized(); ++i) step();
    ASSERT_TRUE(watch->is_localized());
  }
  /// [m] of what it tells from the truth.
  [[nodiscard]] double error() {
    const auto belief = watch->tell_belief({now, watch->odom_from_base_at(now).value()}, now);
    return belief.modes.empty() ? 99.0 : distance(belief.modes.front().map_from_robot.position(), truth.position());
  }

  std::filesystem::path checkpoint =
      std::filesystem::path{::testing::TempDir()} / ("docent_pose_watch_" + std::to_string(getpid()) + ".yaml");
  OccupancyGrid map = testing::room_map();
  sensor_models::RayCaster caster{map};
  LocalizerParams localizer = coarse();
  PoseWatchParams params;
  Pose2 truth{1.0, 0.8, Angle::degrees(20.0)};
  Pose2 raw_from_base{7.0, -3.0, Angle::degrees(50.0)};
  float stranger_at = 0.0F;  // [m] ahead
  Time now = time_from_seconds(1000.0);
  std::unique_ptr<localization::PoseWatch> watch;
};

TEST_F(PoseWatch, NothingIsDueBeforeAnythingIsSeen) {
  EXPECT_FALSE(watch->look(now));
  watch->move(now, raw_from_base);
  EXPECT_FALSE(watch->look(now));
  EXPECT_FALSE(watch->is_localized());
  EXPECT_EQ(watch->start(now).stamp, now);
}

TEST_F(PoseWatch, TellsAPoseWhenItKnowsOneAndKeepsIt) {
  bool was_told_too_early = false;
  for (int i = 0; i < 200 && !watch->is_localized(); ++i) {
    const auto look = step();
    was_told_too_early = was_told_too_early || (look->is_pose_due && !watch->is_localized());
    EXPECT_EQ(std::filesystem::exists(checkpoint), watch->is_localized());
  }
  EXPECT_FALSE(was_told_too_early);
  ASSERT_TRUE(watch->is_localized());
  bool is_told = false;
  for (int i = 0; i < 10; ++i) is_told = is_told | step()->is_pose_due;
  EXPECT_TRUE(is_told);
  EXPECT_LT(error(), 0.15);
  const localization::PoseWatch::Moment moment{now, *watch->odom_from_base_at(now)};
  EXPECT_LT(distance((watch->map_from_raw(moment) * raw_from_base).position(), truth.position()), 0.15);
  EXPECT_LT(distance(watch->map_from_base(moment)->position(), truth.position()), 0.15);
}

TEST_F(PoseWatch, ABeliefIsDueTwiceASecondHoweverLittleIsNew) {
  localizer.reckons_dead = true;  // so that nothing is new any more
  begin();
  find_itself();
  step();
  while (!step()->is_belief_due) {
  }
  (void)watch->tell_belief(watch->start(now), now);
  EXPECT_FALSE(step()->is_belief_due) << "0.2 s";
  EXPECT_FALSE(step()->is_belief_due) << "0.4 s";
  const auto look = step();
  EXPECT_TRUE(look->is_belief_due) << "0.6 s";
  EXPECT_FALSE(look->is_pose_due) << "it goes on by odometry alone";
  EXPECT_TRUE(watch->is_localized());
}

TEST_F(PoseWatch, AJumpOfOdometryIsNoWayAndIsToldAtOnce) {
  localizer.reckons_dead = true;
  begin();
  find_itself();
  step();
  (void)watch->tell_belief(watch->start(now), now);
  raw_from_base = Pose2{0.0, 50.0, {}} * raw_from_base;
  const auto look = step();
  EXPECT_TRUE(look->is_belief_due);
  EXPECT_LT(error(), 0.3) << "it has not moved";
  EXPECT_LT(distance(watch->raw_from_base(look->moment).position(), raw_from_base.position()), 0.2)
      << "others get the odometry's own frame";
  EXPECT_FALSE(step()->is_belief_due);
}

TEST_F(PoseWatch, ANewProcessGoesOnUnlessOdometrySaysThatItWasMoved) {
  find_itself();
  for (int i = 0; i < 10; ++i) step();
  const auto mass_after = [&](const Pose2& raw) {
    begin();
    watch->move(now, raw);
    const auto belief = watch->tell_belief({now, *watch->odom_from_base_at(now)}, now);
    return belief.modes.empty() ? 0.0 : belief.modes.front().mass;
  };
  EXPECT_GT(mass_after(raw_from_base), 0.9);
  EXPECT_LT(error(), 0.2) << "without a look";
  EXPECT_LT(mass_after({100.0, 0.0, {}}), 0.5);
}

TEST_F(PoseWatch, ItIsWhereItIsToldToBe) {
  const BeliefMode told{truth, {0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.003}, 1.0};
  EXPECT_FALSE(watch->start_where_told(told, now)) << "nobody knows odometry";
  watch->move(now, raw_from_base);
  const auto moment = watch->start_where_told(told, now - seconds(1000.0));
  ASSERT_TRUE(moment);
  EXPECT_EQ(moment->stamp, now) << "nobody knows odometry of then";
  EXPECT_LT(error(), 0.15);
}

TEST_F(PoseWatch, ALookIsDueWhenScanAndOdometryOfThenHaveComeAndSoonWithoutIt) {
  const std::vector<float> ranges(10, 2.0F);
  const sensor_models::LaserReading reading{ranges, Angle{}, 0.1, 0.02, 10.0};
  EXPECT_FALSE(watch->is_look_due(now));
  watch->move(now - seconds(0.01), raw_from_base);
  EXPECT_FALSE(watch->is_look_due(now)) << "no scan";
  watch->see(0, now, reading, now);
  EXPECT_FALSE(watch->is_look_due(now)) << "odometry is older than the scan";
  EXPECT_TRUE(watch->awaits_odometry());
  watch->move(now, raw_from_base);
  EXPECT_TRUE(watch->is_look_due(now));
  EXPECT_TRUE(watch->look(now));
  EXPECT_FALSE(watch->is_look_due(now));
  now = now + seconds(0.1);
  watch->see(0, now, reading, now);
  EXPECT_FALSE(watch->is_look_due(now + seconds(0.03)));
  EXPECT_TRUE(watch->is_look_due(now + seconds(0.04))) << "with the odometry that there is";
  EXPECT_TRUE(watch->look(now + seconds(0.04)));
}

TEST_F(PoseWatch, BeamsThatTheMapDoesNotHoldAreToldWithTheirEnds) {
  find_itself();
  stranger_at = 0.3F;
  const auto look = step(false);
  const auto beams = watch->beams(*look);
  ASSERT_EQ(beams.origins.size(), look->sweep.beams.size());
  EXPECT_EQ(beams.origins[180], sensor_models::BeamOrigin::not_map);
  ASSERT_GE(beams.ends.size(), 9U);
  EXPECT_NEAR(beams.ends[beams.ends.size() / 2].x, 0.3, 0.05);
}

TEST_F(PoseWatch, NobodyIsLookedForFarAway) {
  params.person_range = 0.29;
  begin();
  find_itself();
  stranger_at = 0.3F;
  const auto beams = watch->beams(*step(false));
  EXPECT_EQ(beams.origins[180], sensor_models::BeamOrigin::not_map);
  EXPECT_TRUE(beams.ends.empty());
}

TEST_F(PoseWatch, ALaserThatIsFoundElsewhereMovesTheRobotAndNotTheLaser) {
  find_itself();
  for (int i = 0; i < 10; ++i) step();
  const Pose2 before = watch->best_mode().map_from_robot;
  const Pose2 found{0.1, 0.0, Angle::degrees(12.0)};
  watch->mount(0, found);
  const Pose2 laser = watch->best_mode().map_from_robot * found;
  EXPECT_LT(distance(laser.position(), before.position()), 0.12);
  EXPECT_LT(std::abs((laser.theta - before.theta).degrees()), 4.0) << "headings are 3 degrees apart";
  EXPECT_TRUE(watch->verdict().keeps_its_place()) << "it says so when it has looked";
  watch->mount(0, Pose2{0.105, 0.0, Angle::degrees(12.2)});
  EXPECT_LT(distance((watch->best_mode().map_from_robot * found).position(), laser.position()), 1e-9) << "no matter";
}

}  // namespace
}  // namespace docent::localization::pose_watch_test
