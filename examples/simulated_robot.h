#pragma once
// What all examples share: a robot that wanders about in a map. It knows nothing; the examples find out what it knows
// not.
#include <docent/base/random.h>
#include <docent/grid/occupancy_grid.h>
#include <docent/sensor_models/range_sweep.h>
#include <docent/sensor_models/ray_caster.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <type_traits>
#include <utility>

#include "command_line.h"

namespace example {

/// The value, or the end of the program with the reason.
template <class T>
T value_or_exit(docent::Result<T> result) {
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());
    std::exit(2);
  }
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

struct SimulatedRobot {
  docent::sensor_models::RayCaster caster;
  docent::Pose2 map_from_robot;     ///< the truth
  docent::Pose2 odom_from_robot{};  ///< what its wheels say
  docent::Rng rng;                  ///< the same seed, the same drive
  double time = 0.0;                ///< [s]
  double way = 0.0;                 ///< [m]

  SimulatedRobot(const docent::OccupancyGrid& map, const docent::Pose2& start, std::uint64_t seed)
      : caster{map}, map_from_robot{start}, rng{seed} {}

  /// 15 cm ahead, or, where something is near, 10 degrees to the left; the wheels err by some per cent.
  void step() {
    const docent::Point2 ahead = map_from_robot * docent::Point2{0.4, 0.0};
    const bool is_free = caster.clearance(ahead) > 0.5F;
    const docent::Pose2 motion =
        is_free ? docent::Pose2{0.15, 0.0, {}} : docent::Pose2{0.0, 0.0, docent::Angle::degrees(10.0)};
    map_from_robot = map_from_robot * motion;
    odom_from_robot =
        odom_from_robot *
        docent::Pose2{motion.x * rng.normal(1.0, 0.03), 0.0,
                      docent::Angle::radians(motion.theta.radians() * rng.normal(1.0, 0.03) + rng.normal(0.0, 0.003))};
    way += motion.x;
    time += 0.25;
  }

  /// A laser that looks all round, a beam a degree, with an error of 1 cm; farther away than `reach` [m] it sees
  /// nothing.
  docent::sensor_models::RangeSweep look(double reach = 10.0) {
    docent::sensor_models::RangeSweep sweep;
    for (int degree = -180; degree < 180; ++degree) {
      const docent::Angle bearing = docent::Angle::degrees(degree);
      const auto wall =
          caster.cast(map_from_robot.position(), docent::unit(map_from_robot.theta + bearing), reach, 0.3);
      const double range = std::max(0.0, wall.value_or(reach) + rng.normal(0.0, 0.01));
      sweep.beams.push_back({bearing.radians(), std::min(range, reach), range >= reach});
    }
    return sweep;
  }
};

}  // namespace example
