#include "docent/localization/belief/pose_refiner.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "docent/base/random.h"

namespace docent::localization {
namespace {

/// A room of 8 x 6 m with a slanted wall and a case, 5 cm cells.
OccupancyGrid room() {
  OccupancyGrid map;
  map.frame = {160, 120, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      const bool outer = row < 2 || row >= 118 || column < 2 || column >= 158;
      const bool slanted = column + row > 240;
      const bool box = column > 60 && column < 80 && row > 50 && row < 70;
      if (outer || slanted || box) map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
    }
  }
  return map;
}

struct Trial {
  OccupancyGrid map = room();
  sensor_models::RayCaster caster{map};
  Rng rng{11};

  [[nodiscard]] Pose2 any_pose() {
    for (;;) {
      const Pose2 pose{rng.uniform(0.6, 7.0), rng.uniform(0.6, 5.0), Angle::degrees(rng.uniform(-180.0, 180.0))};
      if (caster.clearance(pose.position()) > 0.5F) return pose;
    }
  }
  /// `hidden`: share of the beams that people shorten, in blocks.
  [[nodiscard]] sensor_models::RangeSweep sweep_at(const Pose2& truth, double hidden) {
    sensor_models::RangeSweep sweep;
    double shortened = 0.0;
    for (int degree = -180; degree < 180; degree += 2) {
      if (degree % 20 == 0) shortened = rng.chance(hidden) ? rng.uniform(0.4, 1.5) : 0.0;
      const Angle bearing = Angle::degrees(degree);
      double range = *caster.cast(truth.position(), unit(truth.theta + bearing), 10.0, 0.3) + 0.025;
      range += 0.015 * rng.normal();
      if (shortened > 0.0) range = std::min(range, shortened);
      sweep.beams.push_back({bearing.radians(), range, false});
    }
    return sweep;
  }
};

BeliefMode mode_about(const Pose2& pose) { return {pose, {0.005, 0.0, 0.0, 0.0, 0.005, 0.0, 0.0, 0.0, 0.001}, 1.0}; }

double median_error(double hidden, double off_m, double off_deg) {
  Trial trial;
  std::vector<double> errors;
  for (int i = 0; i < 200; ++i) {
    const Pose2 truth = trial.any_pose();
    const Pose2 believed{truth.x + trial.rng.uniform(-off_m, off_m), truth.y + trial.rng.uniform(-off_m, off_m),
                         truth.theta + Angle::degrees(trial.rng.uniform(-off_deg, off_deg))};
    PoseRefiner refiner{{}};
    const Pose2 refined =
        refiner.refine(mode_about(believed), trial.sweep_at(truth, hidden), {}, 0.0, 0.0, trial.caster, 10.0);
    errors.push_back(distance(refined.position(), truth.position()));
  }
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() / 2];
}

TEST(PoseRefiner, FindsThePoseInsideTheMode) {
  EXPECT_LT(median_error(0.0, 0.08, 3.0), 0.015);
  EXPECT_LT(median_error(0.5, 0.08, 3.0), 0.03);
}

TEST(PoseRefiner, NeverLeavesTheMode) {
  Trial trial;
  for (int i = 0; i < 50; ++i) {
    const Pose2 truth = trial.any_pose();
    const Pose2 elsewhere = trial.any_pose();
    PoseRefiner refiner{{}};
    const Pose2 refined =
        refiner.refine(mode_about(elsewhere), trial.sweep_at(truth, 0.0), {}, 0.0, 0.0, trial.caster, 10.0);
    EXPECT_LE(distance(refined.position(), elsewhere.position()), PoseRefinerParams{}.farthest);
  }
}

TEST(PoseRefiner, GoesOnByOdometryWhileItSeesNoWall) {
  Trial trial;
  PoseRefiner refiner{{}};
  const Pose2 truth{3.0, 1.5, Angle::degrees(10.0)};
  (void)refiner.refine(mode_about(truth), trial.sweep_at(truth, 0.0), {}, 0.0, 0.0, trial.caster, 10.0);
  const Pose2 step{0.2, 0.0, Angle::degrees(5.0)};
  const Pose2 moved = truth * step;
  const Pose2 blurred{moved.x + 0.07, moved.y - 0.06, moved.theta};
  const Pose2 refined = refiner.refine(mode_about(blurred), {}, step, 1e-4, 1e-4, trial.caster, 10.0);
  EXPECT_LT(distance(refined.position(), moved.position()), 0.02);
}

TEST(PoseRefiner, MeetsTheBeliefWhereOdometryIsAllThatIsLeft) {
  Trial trial;
  PoseRefiner refiner{{}};
  Pose2 truth{1.0, 1.0, Angle{}};
  Pose2 refined = refiner.refine(mode_about(truth), trial.sweep_at(truth, 0.0), {}, 0.0, 0.0, trial.caster, 10.0);
  Pose2 by_odometry = refined;
  for (int i = 0; i < 20; ++i) {  // odometry veers by a degree each 25 cm, and nothing is seen
    const Pose2 step{0.25, 0.0, Angle{}};
    const Pose2 measured{0.25, 0.0, Angle::degrees(1.0)};
    truth = truth * step;
    by_odometry = by_odometry * measured;
    refined = refiner.refine(mode_about(truth), {}, measured, 1e-5, 4e-4, trial.caster, 10.0);
  }
  EXPECT_GT(distance(by_odometry.position(), truth.position()), 0.8);
  EXPECT_LT(distance(refined.position(), truth.position()), 0.15);
}

TEST(PoseRefiner, FollowsTheWallsWhenPeoplePushTheBeliefAside) {
  Trial trial;
  PoseRefiner refiner{{}};
  const Pose2 truth{2.0, 1.5, Angle::degrees(10.0)};
  (void)refiner.refine(mode_about(truth), trial.sweep_at(truth, 0.0), {}, 0.0, 0.0, trial.caster, 10.0);
  const Pose2 pushed{truth.x + 0.4, truth.y, truth.theta};
  const Pose2 refined =
      refiner.refine(mode_about(pushed), trial.sweep_at(truth, 0.5), {}, 1e-4, 1e-4, trial.caster, 10.0);
  EXPECT_LT(distance(refined.position(), truth.position()), 0.05);
  const Pose2 elsewhere{truth.x + 1.0, truth.y, truth.theta};  // so far aside the belief knows better
  const Pose2 moved =
      refiner.refine(mode_about(elsewhere), trial.sweep_at(truth, 0.5), {}, 1e-4, 1e-4, trial.caster, 10.0);
  EXPECT_LE(distance(moved.position(), elsewhere.position()), PoseRefinerParams{}.farthest);
}

TEST(PoseRefiner, LeavesAWideModeAlone) {
  Trial trial;
  PoseRefiner refiner{{}};
  BeliefMode wide = mode_about({3.0, 1.5, Angle{}});
  wide.covariance[0] = wide.covariance[4] = 1.0;
  const Pose2 refined =
      refiner.refine(wide, trial.sweep_at({3.1, 1.5, Angle{}}, 0.0), {}, 0.0, 0.0, trial.caster, 10.0);
  EXPECT_EQ(refined.x, wide.map_from_robot.x);
}

}  // namespace
}  // namespace docent::localization
