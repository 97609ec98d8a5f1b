#include "docent/collision_avoidance/virtual_measurements/virtual_measurements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "docent/base/random.h"

namespace docent::collision_avoidance {
namespace {

constexpr double kPi = std::numbers::pi;
const Polygon kArea{{0, 0}, {10, 0}, {10, 8}, {0, 8}};
const Polygon kPlate{{4, 3}, {6, 3}, {6, 5}, {4, 5}};

double true_range(Point2 position, double bearing) {
  double least = VirtualMeasurements::kMaxRange;
  for (const auto& polygon : {kArea, kPlate}) {
    for (const auto& side : sides(polygon)) {
      if (const auto hit = ray_distance(position, unit(Angle::radians(bearing)), side)) least = std::min(least, *hit);
    }
  }
  return least;
}
/// The rule of the papers: each direction by itself.
VirtualMeasurements each_direction() {
  VirtualMeasurementParams params;
  params.jointly = false;
  return {kArea, {kPlate}, params};
}
double bearing_of(int direction) { return (2.0 * direction - 180.0) * kPi / 180.0; }

TEST(VirtualMeasurements, KnownByHand) {
  VirtualMeasurements measurements{kArea, {kPlate}, {}};
  const WeightedPose pose{{2.0, 4.0}, 0.0, 1.0};
  const auto scan = measurements.measure({&pose, 1}, {});
  EXPECT_NEAR(scan.ranges[90], 2.0 - 0.05, 0.051);   // ahead: the plate
  EXPECT_NEAR(scan.ranges[0], 2.0 - 0.05, 0.051);    // behind: the border
  EXPECT_NEAR(scan.ranges[135], 4.0 - 0.05, 0.051);  // to the left: the border
  EXPECT_EQ(scan.possible_mass, 1.0);
}

TEST(VirtualMeasurements, UnderestimatesFromEveryPlaceOfTheCellButNotByMuch) {
  VirtualMeasurementParams params;
  VirtualMeasurements measurements{kArea, {kPlate}, params};
  Rng rng{5};
  double excess = 0.0;
  int count = 0;
  for (int round = 0; round < 300; ++round) {
    const WeightedPose pose{{rng.uniform(0.2, 9.8), rng.uniform(0.2, 7.8)}, rng.uniform(-kPi, kPi), 1.0};
    if (measurements.nearest(pose.position) < 0.15) continue;
    const auto scan = measurements.measure({&pose, 1}, {});
    for (int i = 0; i < 180; ++i) {
      // Anywhere 3 cm around (the lattice takes 1.8 cm of the padding), a degree to either side (rounding of the
      // heading takes the other half).
      const double way = rng.uniform(0.0, 0.03);
      const Point2 from = pose.position + way * unit(Angle::radians(rng.uniform(-kPi, kPi)));
      const double truth = true_range(from, pose.heading + bearing_of(i));
      EXPECT_LE(scan.ranges[static_cast<std::size_t>(i)], truth + 1e-9)
          << pose.position.x << " " << pose.position.y << " " << pose.heading << " direction " << i;
      excess += std::min(2.0, truth - scan.ranges[static_cast<std::size_t>(i)]);
      ++count;
    }
  }
  EXPECT_LT(excess / count, 0.25);
}

/// The slow twin of the rule: sort the distances of all poses, walk up to one percent.
double quantile(std::vector<std::pair<double, double>> distance_and_mass) {
  std::sort(distance_and_mass.begin(), distance_and_mass.end());
  double all = 0.0;
  for (const auto& [range, mass] : distance_and_mass) all += mass;
  double below = 0.0;
  for (const auto& [range, mass] : distance_and_mass) {
    below += mass;
    if (below >= 0.01 * all) return range;
  }
  return VirtualMeasurements::kMaxRange;
}

TEST(VirtualMeasurements, NinetyNinePercentRuleAgreesWithASlowTwin) {
  Rng rng{9};
  for (int round = 0; round < 10; ++round) {
    VirtualMeasurements measurements = each_direction();
    const Point2 middle{rng.uniform(1, 3), rng.uniform(1, 7)};
    std::vector<WeightedPose> belief;
    for (int i = 0; i < 400; ++i) {
      belief.push_back({{middle.x + rng.normal(0.0, 0.2), middle.y + rng.normal(0.0, 0.2)},
                        rng.normal(0.5, 0.1),
                        rng.uniform(0.0, 1.0)});
    }
    std::erase_if(belief, [&](const auto& pose) { return measurements.nearest(pose.position) < 0.05; });
    const auto scan = measurements.measure(belief, {});
    for (std::size_t i = 0; i < 180; i += 15) {
      std::vector<std::pair<double, double>> singles;
      for (const auto& pose : belief) {
        singles.emplace_back(measurements.measure({&pose, 1}, {}).ranges[i], pose.mass);
      }
      EXPECT_DOUBLE_EQ(scan.ranges[i], quantile(singles)) << i;
    }
  }
}

/// The slow twin: the mass of every pose in the bin of every direction, added up.
std::array<double, 180> plain_histogram(VirtualMeasurements& measurements, const std::vector<WeightedPose>& belief) {
  std::array<std::array<double, VirtualMeasurements::kBins>, 180> histogram{};
  double total = 0.0;
  for (const auto& pose : belief) {
    if (!measurements.is_possible(pose.position)) continue;
    total += pose.mass;
    const auto seen = measurements.measure({&pose, 1}, {}).ranges;
    for (std::size_t i = 0; i < 180; ++i) {
      histogram[i][static_cast<std::size_t>(std::lround(seen[i] / VirtualMeasurements::kBin))] += pose.mass;
    }
  }
  std::array<double, 180> ranges{};
  for (std::size_t i = 0; i < 180; ++i) {
    double below = 0.0;
    std::size_t bin = 0;
    while (bin + 1 < VirtualMeasurements::kBins && (below += histogram[i][bin]) < 0.01 * total) ++bin;
    ranges[i] = VirtualMeasurements::kBin * static_cast<double>(bin);
  }
  return ranges;
}

TEST(VirtualMeasurements, PassOverNothingThatMatters) {
  VirtualMeasurements measurements = each_direction();
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    Rng rng{seed};
    std::vector<WeightedPose> belief;
    const double spread = std::array{0.05, 0.4, 2.0}[seed % 3];
    const Point2 centre{rng.uniform(1, 9), rng.uniform(1, 2)};  // mostly clear of the plate
    const auto count = seed % 2 == 0 ? 1600 : rng.integer(1, 300);
    while (static_cast<std::int64_t>(belief.size()) < count) {
      const Point2 at{centre.x + rng.normal(0.0, spread), centre.y + rng.normal(0.0, spread)};
      // On the lattice, and no tie between two masses.
      const Point2 place{0.15 * std::round(at.x / 0.15), 0.15 * std::round(at.y / 0.15)};
      const double mass = seed % 4 == 0 ? std::exp(rng.normal(0.0, 3.0)) : rng.uniform(0.5, 1.5);
      if (!measurements.is_possible(place) && belief.size() % 7 != 0) continue;  // some may be impossible
      belief.push_back({place, rng.uniform(-kPi, kPi), mass});
    }
    const auto wanted = plain_histogram(measurements, belief);
    const auto ranges = measurements.measure(belief, {}).ranges;
    for (std::size_t i = 0; i < 180; ++i) ASSERT_DOUBLE_EQ(ranges[i], wanted[i]) << "seed " << seed << " at " << i;
  }
}

TEST(VirtualMeasurements, WhatWasMeasuredBeforeChangesNothing) {
  VirtualMeasurements used = each_direction();
  Rng rng{11};
  Point2 middle{2.0, 2.0};
  double heading = 0.0;
  for (int round = 0; round < 60; ++round) {
    const bool is_carried = round % 6 == 5;  // else it drives on and turns, slowly or fast
    middle = is_carried ? Point2{rng.uniform(0.5, 9.5), rng.uniform(0.5, 7.5)}
                        : middle + rng.uniform(0.0, 0.4) * unit(Angle::radians(heading));
    heading += rng.uniform(-0.5, 0.5);
    const double spread = rng.chance(0.5) ? 0.1 : 1.5;
    std::vector<WeightedPose> poses;
    for (int i = 0; i < (round % 2 == 0 ? 300 : 1500); ++i)
      poses.push_back({middle + Point2{rng.uniform(-spread, spread), rng.uniform(-spread, spread)},
                       heading + rng.uniform(-0.1, 0.1), rng.uniform(0.0, 1.0)});
    const WeightedSquare rest{{5.0, 2.0}, 1.0, rng.uniform(0.0, 5.0)};
    VirtualMeasurements fresh = each_direction();
    EXPECT_EQ(used.measure(poses, {&rest, 1}).ranges, fresh.measure(poses, {&rest, 1}).ranges) << round;
  }
}

TEST(VirtualMeasurements, AllDirectionsUnderestimateAtOnce) {
  VirtualMeasurements alone = each_direction();
  VirtualMeasurements together{kArea, {kPlate}, {}};
  int alone_over = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng{seed};
    const double spread = std::array{0.05, 0.3, 1.0}[seed % 3];
    const Point2 centre{rng.uniform(1, 3), rng.uniform(1, 7)};
    std::vector<WeightedPose> belief;
    double total = 0.0;
    for (int i = 0; i < 600; ++i) {
      const Point2 at{centre.x + rng.normal(0.0, spread), centre.y + rng.normal(0.0, spread)};
      if (!together.is_possible(at)) continue;
      belief.push_back({at, rng.normal(0.3, 0.2), std::exp(rng.normal(0.0, 1.0))});
      total += belief.back().mass;
    }
    const std::vector<WeightedSquare> rest{{{8.0, 1.0}, 0.5, 0.004 * total}, {{8.0, 4.0}, 0.5, 0.002 * total}};
    const auto mass_overstated = [&](VirtualMeasurements& measurements) {
      const auto ranges = measurements.measure(belief, rest).ranges;
      const double longest = *std::max_element(ranges.begin(), ranges.end());
      double over = 0.0;
      for (const auto& pose : belief) {
        const auto seen = alone.measure({&pose, 1}, {}).ranges;
        bool is_over = false;
        for (std::size_t i = 0; i < 180; ++i) is_over = is_over || ranges[i] > seen[i] + 1e-9;
        over += is_over ? pose.mass : 0.0;
      }
      for (const auto& square : rest) {
        const double seen = alone.nearest(square.centre) - 0.5 * std::sqrt(2.0) * square.side;
        over += longest > seen + 0.05 ? square.mass : 0.0;
      }
      return over / (1.006 * total);
    };
    EXPECT_LE(mass_overstated(together), 0.01 + 1e-9) << "seed " << seed;
    alone_over += mass_overstated(alone) > 0.01 ? 1 : 0;
    const auto careful = together.measure(belief, rest).ranges;
    const auto plain = alone.measure(belief, rest).ranges;
    for (std::size_t i = 0; i < 180; ++i) EXPECT_LE(careful[i], plain[i]) << "seed " << seed << " direction " << i;
  }
  EXPECT_GE(alone_over, 20) << "each direction by itself leaves more than a hundredth";
}

TEST(VirtualMeasurements, TheWholeBeliefCountsNotTheBestPoseAlone) {
  const std::vector<WeightedPose> belief{{{1.0, 4.0}, 0.0, 0.97}, {{3.5, 4.0}, 0.0, 0.03}};
  VirtualMeasurements whole{kArea, {kPlate}, {}};
  EXPECT_NEAR(whole.measure(belief, {}).ranges[90], 0.45, 0.051);
  VirtualMeasurementParams params;
  params.best_pose_only = true;
  VirtualMeasurements crippled{kArea, {kPlate}, params};
  EXPECT_NEAR(crippled.measure(belief, {}).ranges[90], 2.95, 0.051);
  // Less than one percent is what the rule ignores.
  const std::vector<WeightedPose> sure{{{1.0, 4.0}, 0.0, 0.995}, {{3.5, 4.0}, 0.0, 0.005}};
  EXPECT_NEAR(whole.measure(sure, {}).ranges[90], 2.95, 0.051);
}

TEST(VirtualMeasurements, PosesWhereTheRobotCannotBeAreLeftOut) {
  VirtualMeasurements measurements{kArea, {kPlate}, {}};
  const std::vector<WeightedPose> belief{{{3.7, 4.0}, kPi, 0.7}, {{4.1, 4.0}, kPi, 0.2}, {{-0.5, 4.0}, kPi, 0.1}};
  const auto scan = measurements.measure(belief, {});
  EXPECT_NEAR(scan.possible_mass, 0.7, 1e-12);
  EXPECT_NEAR(scan.ranges[90], 3.65, 0.051);  // towards the border, as seen from the one possible pose
  EXPECT_NEAR(scan.ranges[0], 0.25, 0.051);   // the plate behind
}

TEST(VirtualMeasurements, ARobotThatIsSurelyOutsideMayOnlyComeBack) {
  VirtualMeasurements measurements{kArea, {kPlate}, {}};
  const WeightedPose outside{{-0.2, 4.0}, 0.0, 1.0};
  const auto scan = measurements.measure({&outside, 1}, {});
  EXPECT_EQ(scan.possible_mass, 0.0);
  EXPECT_EQ(scan.ranges[90], VirtualMeasurements::kMaxRange);
  EXPECT_LE(scan.ranges[0], 0.051);
  EXPECT_LE(scan.ranges[135], 0.051);
}

TEST(VirtualMeasurements, ARobotRoundWhichAHazardWasDrawnMayLeaveByTheNearestEdgeAlone) {
  VirtualMeasurements measurements{kArea, {kPlate}, {}};
  const WeightedPose inside{{5.3, 4.0}, 0.0, 1.0};  // the nearest edge is 0.7 m ahead
  const auto scan = measurements.measure({&inside, 1}, {});
  EXPECT_EQ(scan.ranges[90], VirtualMeasurements::kMaxRange);
  EXPECT_LE(scan.ranges[0], 0.051) << "back, 1.3 m";
  EXPECT_LE(scan.ranges[158], 0.051) << "back to the left: nothing there lets it go to the left";
}

TEST(VirtualMeasurements, TheRestCountsWithItsNearestHazardInEveryDirection) {
  VirtualMeasurements measurements{kArea, {kPlate}, {}};
  const WeightedPose pose{{2.0, 4.0}, 0.0, 0.98};
  const WeightedSquare near{{1.0, 1.0}, 0.5, 0.02};
  const auto scan = measurements.measure({&pose, 1}, {&near, 1});
  for (const double range : scan.ranges) EXPECT_LE(range, 0.65);
  const WeightedSquare nowhere{{20.0, 20.0}, 0.5, 0.02};
  EXPECT_NEAR(measurements.measure({&pose, 1}, {&nowhere, 1}).ranges[90], 1.95, 0.051);
}

TEST(VirtualMeasurements, ABroadBeliefLeavesOnlyTurningOnTheSpot) {
  VirtualMeasurements measurements{kArea, {kPlate}, {}};
  std::vector<WeightedPose> belief;
  for (double x = 0.075; x < 10; x += 0.15) {
    for (double y = 0.075; y < 8; y += 0.15) {
      for (int heading = 0; heading < 4; ++heading) belief.push_back({{x, y}, heading * 0.5 * kPi, 1.0});
    }
  }
  const auto scan = measurements.measure(belief, {});
  for (const double range : scan.ranges) EXPECT_LT(range, 0.4);
  const auto nothing = measurements.measure({}, {});
  for (const double range : nothing.ranges) EXPECT_EQ(range, 0.0);
}

TEST(VirtualMeasurements, ParametersAreChecked) {
  VirtualMeasurementParams params;
  EXPECT_TRUE(params.validate());
  params.confidence = 1.0;
  EXPECT_FALSE(params.validate());
}

}  // namespace
}  // namespace docent::collision_avoidance
