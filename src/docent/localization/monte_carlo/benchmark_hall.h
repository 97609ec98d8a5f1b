#pragma once

#include <string>
#include <vector>

#include "docent/localization/monte_carlo/field_kernel.h"
#include "docent/localization/monte_carlo/testing.h"
#include "docent/sensor_models/ray_caster.h"

/// What the benchmarks of this folder have in common.
namespace docent::localization::testing {

inline constexpr int kHallBeams = 180;
inline constexpr std::size_t kHallParticles = 10000;

/// A hall of 50 x 50 m with walls and cases, at 5 cm.
inline OccupancyGrid hall_map() {
  OccupancyGrid map;
  map.frame = {1000, 1000, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  const auto fill = [&map](int left, int bottom, int right, int top) {
    for (int row = bottom; row < top; ++row)
      for (int column = left; column < right; ++column)
        map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
  };
  fill(0, 0, 1000, 4), fill(0, 996, 1000, 1000), fill(0, 0, 4, 1000), fill(996, 0, 1000, 1000);
  fill(400, 0, 404, 420), fill(404, 416, 700, 420);
  Rng rng{1};
  for (int i = 0; i < 60; ++i) {
    const int left = static_cast<int>(rng.integer(10, 970));
    const int bottom = static_cast<int>(rng.integer(10, 970));
    fill(left, bottom, left + 12, bottom + 18);
  }
  return map;
}

inline const Pose2 kHallPose{25.3, 24.1, Angle::degrees(35.0)};

/// A whole turn in `kHallBeams` ranges [m], with 2 cm of noise.
inline std::vector<double> hall_scan(const sensor_models::RayCaster& caster) {
  Rng rng{2};
  std::vector<double> ranges;
  for (int i = 0; i < kHallBeams; ++i) {
    const Angle bearing = Angle::degrees(-180.0 + i * 360.0 / kHallBeams);
    ranges.push_back(caster.cast(kHallPose.position(), unit(kHallPose.theta + bearing), 29.0, 0.3).value_or(29.0) +
                     rng.normal(0.025, 0.02));
  }
  return ranges;
}

/// Where the beams end [m], robot frame.
inline std::vector<Point2> hall_ends(const std::vector<double>& ranges) {
  std::vector<Point2> ends;
  for (std::size_t i = 0; i < ranges.size(); ++i)
    ends.push_back(ranges[i] * unit(Angle::degrees(-180.0 + static_cast<double>(i) * 360.0 / kHallBeams)));
  return ends;
}

inline FieldBeams hall_beams(const LikelihoodField& field, const std::vector<double>& ranges) {
  constexpr std::size_t kSectorBeams = 15;
  FieldBeams beams;
  for (const Point2 end : hall_ends(ranges)) {
    beams.add(field.view(), end);
    if (beams.ends.size() % kSectorBeams == 0) beams.close_sector();
  }
  return beams;
}

/// Tracking: a cloud of `spread` [m] and 5 degrees about the pose.
inline ParticleSet hall_cloud(double spread) {
  Rng rng{3};
  ParticleSet particles;
  particles.resize(kHallParticles);
  for (std::size_t i = 0; i < kHallParticles; ++i) {
    const double x = rng.normal(kHallPose.x, spread);
    const double y = rng.normal(kHallPose.y, spread);
    particles.set(i, {x, y, kHallPose.theta + Angle::degrees(rng.normal(0.0, 5.0))}, 1e-4F);
  }
  return particles;
}

}  // namespace docent::localization::testing
