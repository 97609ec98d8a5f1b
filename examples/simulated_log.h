#pragma once
// A CARMEN log of a drive in a museum's map, for 05_map_a_log: text, one line a scan.
#include <fstream>
#include <string>
#include <vector>

#include "simulated_robot.h"

namespace example {

/// Writes simulated.log: beams a degree apart in the half circle ahead, and odometry. Appends the true pose of each
/// scan.
/// @returns its path
inline std::string write_log(const std::string& museum, std::vector<docent::Pose2>& truth) {
  const docent::OccupancyGrid map = value_or_exit(docent::load_map(museum + "/map.yaml"));
  SimulatedRobot robot{map, {9.0, 3.6, docent::Angle::degrees(90.0)}, 5};
  std::ofstream log{"simulated.log"};
  while (robot.way < 100.0) {
    robot.step();
    const docent::sensor_models::RangeSweep sweep = robot.look(30.0);
    log << "FLASER 181";
    for (const auto& beam : sweep.beams)  // from -90 to +90 degrees; a SICK writes 81.83 where nothing comes back
      if (std::abs(beam.bearing) < docent::kRightAngle + 1e-6) log << ' ' << (beam.no_return ? 81.83 : beam.range);
    const docent::Pose2& odom = robot.odom_from_robot;
    for (int pose = 0; pose < 2; ++pose) log << ' ' << odom.x << ' ' << odom.y << ' ' << odom.theta.radians();
    log << ' ' << robot.time << " nohost " << robot.time << '\n';
    truth.push_back(robot.map_from_robot);
  }
  return "simulated.log";
}

}  // namespace example
