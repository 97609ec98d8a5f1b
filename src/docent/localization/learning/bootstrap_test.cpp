#include "docent/localization/learning/bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/base/random.h"

namespace docent::localization {
namespace {

/// A hall of 9 x 6 m without symmetry, as a grid of 5 cm.
OccupancyGrid hall() {
  OccupancyGrid map;
  map.frame = {180, 120, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  const auto fill = [&map](int left, int bottom, int right, int top) {
    for (int row = bottom; row < top; ++row)
      for (int column = left; column < right; ++column)
        map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
  };
  fill(0, 0, 180, 2), fill(0, 118, 180, 120), fill(0, 0, 2, 120), fill(178, 0, 180, 120);
  fill(70, 0, 74, 40);     // a wall from below
  fill(25, 90, 60, 118);   // a cupboard
  fill(140, 30, 160, 50);  // a pillar
  fill(110, 95, 114, 118);
  fill(2, 30, 14, 44);
  return map;
}

sensor_models::ProximityModelParams true_sensor() {
  sensor_models::ProximityModelParams params;
  params.max_range = 8.0;
  params.sigma = 0.03;
  params.sigma_per_metre = 0.0;
  params.short_per_metre = 0.6;
  params.weight_hit = 0.75;
  params.weight_near = 0.0;
  params.weight_short = 0.2;
  params.weight_no_return = 0.02;
  params.weight_random = 0.03;
  return params;
}

motion_models::LabelledMotionNoise true_wheels() {
  motion_models::LabelledMotionNoise noise;
  noise.motion = {0.0008, 0.0002, 0.0006, 0.002, 0.0};
  return noise;
}

/// A drive round the pillar and the wall's end, with the sensor and the wheels above. `truth` gets the poses.
std::vector<RecordedSweep> drive(std::uint64_t seed, const OccupancyGrid& map, int rounds, std::vector<Pose2>& truth) {
  const std::vector<Point2> corners{{2.0, 3.0}, {5.0, 3.6}, {8.3, 3.6}, {8.4, 0.9}, {5.0, 0.9}, {5.0, 3.4}, {1.8, 3.6}};
  Rng rng{seed};
  const sensor_models::RayCaster caster{map};
  const sensor_models::ProximityModel sensor{true_sensor()};
  const motion_models::OdometryModelParams wheels = true_wheels().motion;
  std::vector<RecordedSweep> sweeps;
  Pose2 odometry;
  Pose2 real{2.0, 3.0, Angle::degrees(10)};
  const auto step = [&](const Pose2& motion) {
    real = real * motion;
    const motion_models::MotionNoise noise = motion_models::motion_noise(wheels, motion);
    odometry =
        odometry * motion *
        Pose2{rng.normal(0.0, std::sqrt(noise.position_variance)), rng.normal(0.0, std::sqrt(noise.position_variance)),
              Angle::radians(rng.normal(0.0, std::sqrt(noise.heading_variance)))};
    RecordedSweep recorded;
    recorded.time = time_from_seconds(0.3 * static_cast<double>(sweeps.size()));
    recorded.odom_from_base = odometry;
    for (int degree = -120; degree <= 120; degree += 2) {
      const Angle bearing = Angle::degrees(degree);
      const double wall = caster.cast(real.position(), unit(real.theta + bearing), 8.0, 0.3).value_or(8.0) + 0.025;
      const int expected = sensor.bin(wall);
      double left = rng.uniform();
      int measured = 0;
      while (measured < sensor_models::kNoReturn && (left -= sensor.probability(measured, expected)) >= 0.0) ++measured;
      recorded.sweep.beams.push_back(
          {bearing.radians(), std::min(8.0, sensor.centre(measured)), measured == sensor_models::kNoReturn});
    }
    sweeps.push_back(std::move(recorded));
    truth.push_back(real);
  };
  for (int i = 1; i < rounds * static_cast<int>(corners.size()); ++i) {
    const Point2 goal = corners[static_cast<std::size_t>(i) % corners.size()];
    const Angle turn = direction(real.position(), goal) - real.theta;
    const int turns = 1 + static_cast<int>(std::abs(turn.degrees()) / 15.0);
    for (int n = 0; n < turns; ++n) step({0.0, 0.0, Angle::radians(turn.radians() / turns)});
    const double way = distance(real.position(), goal);
    const int steps = 1 + static_cast<int>(way / 0.2);
    for (int n = 0; n < steps; ++n) step({way / steps, 0.0, {}});
  }
  return sweeps;
}

LocalizerParams start_params() {
  LocalizerParams params;
  params.sensor.max_range = 8.0;
  return params;
}

TEST(Labels, AreSureAndRightOnceBothRunsAgree) {
  const OccupancyGrid map = hall();
  std::vector<Pose2> truth;
  const auto sweeps = drive(1, map, 2, truth);
  MarkovLocalizer localizer{map, start_params(), {}, 1};
  const Labelling labelling = label(sweeps, localizer, {});
  ASSERT_EQ(labelling.labels.size(), sweeps.size());
  EXPECT_GT(static_cast<double>(labelling.sure), 0.9 * static_cast<double>(sweeps.size()));
  double sum = 0.0;
  double most = 0.0;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    if (!labelling.labels[i].sure) continue;
    const double off = distance(labelling.labels[i].map_from_base.position(), truth[i].position());
    sum += off;
    most = std::max(most, off);
  }
  EXPECT_LT(sum / static_cast<double>(labelling.sure), 0.07);
  EXPECT_LT(most, 0.4);
}

TEST(Labels, NothingIsSureInAMapOfAnotherBuilding) {
  std::vector<Pose2> truth;
  const auto sweeps = drive(1, hall(), 1, truth);
  OccupancyGrid other;
  other.frame = {120, 120, 0.05, {}};
  other.cells.assign(other.frame.size(), OccupancyGrid::kFree);
  for (int i = 0; i < 120; ++i)
    for (const CellIndex cell : {CellIndex{i, 0}, CellIndex{i, 119}, CellIndex{0, i}, CellIndex{119, i}})
      other.cells[other.frame.index(cell)] = OccupancyGrid::kOccupied;
  MarkovLocalizer localizer{other, start_params(), {}, 1};
  EXPECT_LT(static_cast<double>(label(sweeps, localizer, {}).sure), 0.1 * static_cast<double>(sweeps.size()));
}

TEST(Pieces, EveryFourthIsHeldOutAndNeighboursStayTogether) {
  std::vector<RecordedSweep> sweeps(401);
  for (std::size_t i = 0; i < sweeps.size(); ++i) sweeps[i].odom_from_base = {0.1 * static_cast<double>(i), 0.0, {}};
  const Pieces pieces = pieces_of(sweeps);
  EXPECT_EQ(pieces.count, 17);  // 40 m in pieces of 2.5 m, and the last sweep
  int changes = 0;
  std::size_t held_out = 0;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    if (i > 0) changes += pieces.piece[i] != pieces.piece[i - 1] ? 1 : 0;
    held_out += Pieces::is_held_out(pieces.piece[i]) ? 1 : 0;
  }
  EXPECT_EQ(changes, 16);
  EXPECT_NEAR(static_cast<double>(held_out), 100.0, 3.0);
}

TEST(Readings, CountOnlyWhereTheRobotIsSureAndMoved) {
  const OccupancyGrid map = hall();
  const LocalizerParams params = start_params();
  const sensor_models::RayCaster caster{map};
  const StateSpace space{map, caster, params.states};
  const RangeTable table = RangeTable::build(space, caster, sensor_models::ProximityModel{params.sensor});
  const Expectation at_pose{space, table, caster, 8.0, ExpectedAt::pose};
  std::vector<RecordedSweep> sweeps(40);
  std::vector<PoseLabel> labels(40);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const double x = i < 20 ? 0.0 : 0.2 * static_cast<double>(i - 19);  // it stands, then drives 4 m
    sweeps[i].odom_from_base = {x, 0.0, {}};
    sweeps[i].time = time_from_seconds(static_cast<double>(i));
    sweeps[i].sweep.beams.push_back({std::numbers::pi / 2.0, 1.0, false});
    labels[i] = {{1.5 + x, 3.0, {}}, i < 30};
  }
  const auto counted = count_readings(sweeps, sweeps, labels, pieces_of(sweeps), at_pose, {});
  EXPECT_EQ(counted.sweeps, 11U);
  std::uint64_t all = counted.fitted.total();
  for (const sensor_models::ReadingCounts& piece : counted.held_out) all += piece.total();
  EXPECT_EQ(all, 11U);
  // The cupboard's edge stands 1.5 m to the left, the surface half a cell deeper.
  const int measured = at_pose.bins().bin(1.0);
  EXPECT_GT(counted.fitted.at(measured, at_pose.bins().bin(1.525)), 0U);
}

class BootstrapInTheHall : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(BootstrapInTheHall, FindsSensorAndWheels) {
  const OccupancyGrid map = hall();
  std::vector<Pose2> truth;
  std::vector<LearningRecording> recordings(2);
  recordings[0].lasers = drive(GetParam(), map, 3, truth);
  recordings[1].lasers = drive(GetParam() + 100, map, 3, truth);
  BootstrapParams params;
  params.expected_at = ExpectedAt::pose;
  params.proofs = 1;
  params.most_iterations = 1;
  std::size_t lines = 0;
  const auto learned = bootstrap(recordings, map, start_params(), params, [&](const std::string&) { ++lines; });
  ASSERT_TRUE(learned) << learned.error().message;
  EXPECT_GT(lines, 0U);
  const sensor_models::ProximityModelParams real = true_sensor();
  // The labels' own error of some centimetres comes on top of the sensor's.
  EXPECT_GT(learned->sensor.sigma, real.sigma);
  EXPECT_LT(learned->sensor.sigma, real.sigma + 0.06);
  EXPECT_NEAR(learned->sensor.weight_short, real.weight_short, 0.05);
  EXPECT_NEAR(learned->sensor.short_per_metre, real.short_per_metre, 0.25);
  EXPECT_NEAR(learned->sensor.weight_no_return, real.weight_no_return, 0.02);
  EXPECT_GT(learned->sensor.weight_hit + learned->sensor.weight_near, 0.65);
  for (const HeldOut& held_out : {learned->on_first_labels, learned->on_last_labels}) {
    EXPECT_GT(held_out.readings, 1000U);
    EXPECT_GT(held_out.after - held_out.before, 2.0 * held_out.uncertainty);
  }
  ASSERT_TRUE(learned->motion) << learned->motion_fault;
  // Three metres and half a turn: deviations within 40 %, from labels that err more than the wheels.
  const Pose2 way{3.0, 0.0, Angle::degrees(180)};
  const motion_models::MotionNoise found = motion_models::motion_noise(learned->motion->noise.motion, way);
  const motion_models::MotionNoise wheels = motion_models::motion_noise(true_wheels().motion, way);
  EXPECT_NEAR(std::sqrt(found.heading_variance / wheels.heading_variance), 1.0, 0.4);
  EXPECT_NEAR(std::sqrt(found.position_variance / wheels.position_variance), 1.0, 0.6);
  EXPECT_GT(learned->motion_held_after, learned->motion_held_before);
  EXPECT_LT(std::sqrt(learned->motion->noise.label_position), 0.08);
}
INSTANTIATE_TEST_SUITE_P(Seeds, BootstrapInTheHall, ::testing::Values(11));

TEST(Bootstrap, SaysWhenTheRobotIsNowhereSure) {
  std::vector<LearningRecording> recordings(1);
  RecordedSweep blind;
  blind.sweep.beams.push_back({0.0, 8.0, true});
  recordings[0].lasers.assign(20, blind);
  const auto learned = bootstrap(recordings, hall(), start_params(), {}, [](const std::string&) {});
  ASSERT_FALSE(learned);
  EXPECT_EQ(learned.error().message, "the robot is nowhere sure of its place");
}

}  // namespace
}  // namespace docent::localization
