#pragma once
// A base on the bus, for 06_a_module_of_your_own_on_the_bus: it obeys cmd_vel and publishes what its laser sees, ten
// times a second.
#include <docent/messages/topics.h>
#include <docent/transport/bus.h>

#include <cmath>

#include "simulated_robot.h"

namespace example {

class SimulatedBase {
 public:
  SimulatedBase(docent::transport::Bus& bus, const docent::OccupancyGrid& map)
      : robot_{map, {9.0, 3.6, docent::Angle::degrees(90.0)}, 6}, scans_{bus.publisher(docent::topics::kScanFront)} {
    bus.subscribe<docent::geometry_msgs::Twist>(docent::topics::kCommandVelocity,
                                                [this](const auto& command) { speed_ = command.linear.x; });
    bus.every(docent::seconds(0.1), [this] { drive_and_look(); });
  }
  SimulatedBase(const SimulatedBase&) = delete;
  docent::sensor_models::RangeSweep look() { return robot_.look(); }
  const docent::Pose2& pose() const { return robot_.map_from_robot; }

 private:
  void drive_and_look() {
    robot_.map_from_robot = robot_.map_from_robot * docent::Pose2{0.1 * speed_, 0.0, {}};
    docent::sensor_msgs::LaserScan scan;
    scan.header.frame_id = "laser_front";
    scan.angle_min = -0.5F, scan.angle_max = 0.5F, scan.angle_increment = static_cast<float>(docent::kDegree),
    scan.range_max = 10.0F;
    for (const auto& beam : robot_.look().beams)
      if (std::abs(beam.bearing) <= 0.5) scan.ranges.push_back(static_cast<float>(beam.range));
    scans_.publish(scan);
  }
  SimulatedRobot robot_;
  docent::transport::Publisher<docent::sensor_msgs::LaserScan> scans_;
  double speed_ = 0.0;
};

}  // namespace example
