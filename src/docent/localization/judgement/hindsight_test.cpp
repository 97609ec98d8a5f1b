#include "docent/localization/judgement/hindsight.h"

#include <gtest/gtest.h>

#include <numbers>

namespace docent::localization {
namespace {

constexpr double kSightRange = 10.0;  // [m]

/// A corridor 30 m long with niches of their own widths, and a hall beside it.
OccupancyGrid corridor() {
  OccupancyGrid map;
  map.frame = {340, 140, 0.1, {-1.0, -1.0}};
  map.cells.assign(map.frame.size(), 100);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const Point2 at{-1.0 + 0.1 * (static_cast<double>(i % 340) + 0.5),
                    -1.0 + 0.1 * (static_cast<double>(i / 340) + 0.5)};
    const bool is_way = at.x > 0.0 && at.x < 32.0 && at.y > 0.0 && at.y < 2.0;
    const bool is_niche = at.y > 0.0 && at.y < 3.0 &&
                          ((at.x > 3.0 && at.x < 4.5) || (at.x > 9.0 && at.x < 12.0) || (at.x > 17.0 && at.x < 17.8) ||
                           (at.x > 26.0 && at.x < 28.0));
    const bool is_hall =
        at.x > 2.0 && at.x < 24.0 && at.y > 5.0 && at.y < 12.0 && !(at.x > 12.0 && at.x < 14.0 && at.y < 8.0);
    if (is_way || is_niche || is_hall) map.cells[i] = 0;
  }
  return map;
}

class Hindsight : public testing::Test {
 protected:
  void look(const Pose2& said, bool says) {
    PastSweep past;
    for (int i = 0; i < 90; ++i) {
      sensor_models::SweepBeam beam;
      beam.bearing = (4.0 * i - 180.0) * std::numbers::pi / 180.0;
      const auto seen =
          caster_.cast(pose_.position(), unit(pose_.theta + Angle::radians(beam.bearing)), kSightRange, kSightRange);
      beam.range = seen.value_or(kSightRange);
      beam.no_return = !seen;
      past.sweep.beams.push_back(beam);
    }
    past.odom_from_robot = odom_;
    if (says) past.best = said;
    past.is_sure = says;
    sweeps_.push_back(past);
    truth_.push_back(pose_);
  }
  void drive(double way) {
    pose_ = pose_ * Pose2{way, 0.0, {}};
    odom_ = odom_ * Pose2{1.02 * way, 0.0, Angle::degrees(0.3)};  // wheels err
  }
  [[nodiscard]] std::vector<std::optional<Pose2>> looked_back() const {
    HindsightParams params;
    params.max_range = kSightRange;
    return seen_in_hindsight(caster_, sweeps_, params);
  }
  void expect_truth(const std::vector<std::optional<Pose2>>& poses, std::size_t first, std::size_t end) const {
    for (std::size_t i = first; i < end; ++i) {
      ASSERT_TRUE(poses[i]) << i;
      EXPECT_LT(distance(poses[i]->position(), truth_[i].position()), 0.2) << i;
    }
  }

  OccupancyGrid map_ = corridor();
  sensor_models::RayCaster caster_{map_};
  Pose2 pose_{1.0, 1.0, {}}, odom_;
  std::vector<PastSweep> sweeps_;
  std::vector<Pose2> truth_;
};

TEST_F(Hindsight, ARobotThatWasNeverSureKnowsNothing) {
  for (int i = 0; i < 20; ++i) {
    look({}, false);
    drive(0.2);
  }
  for (const auto& pose : looked_back()) EXPECT_FALSE(pose);
}

TEST_F(Hindsight, TheWayBackIsKnownOnceTheRobotIs) {
  for (int i = 0; i < 140; ++i) {
    look(pose_, i == 120);
    drive(0.2);
  }
  const auto poses = looked_back();
  expect_truth(poses, 0, 120);
  EXPECT_FALSE(poses[139]) << "what came later is not seen by looking back";
}

TEST_F(Hindsight, APlaceThatItWronglySaidIsTakenBack) {
  for (int i = 0; i < 140; ++i) {
    look(i < 60 ? pose_ * Pose2{6.0, 0.0, {}} : pose_, (i > 20 && i < 60) || i > 110);
    drive(0.2);
  }
  expect_truth(looked_back(), 0, 140);
}

TEST_F(Hindsight, ARobotThatWasCarriedOffWasWhereItSaidBefore) {
  for (int i = 0; i < 70; ++i) {
    look(pose_, i > 10 && i < 50);
    drive(0.2);
  }
  pose_ = {4.0, 10.0, {}};
  for (int i = 0; i < 70; ++i) {
    look(pose_, i > 40);
    drive(0.2);
  }
  const auto poses = looked_back();
  expect_truth(poses, 0, 66);
  expect_truth(poses, 74, 140);
}

}  // namespace
}  // namespace docent::localization
