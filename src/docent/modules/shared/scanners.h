#pragma once

#include <cstddef>
#include <vector>

#include "docent/messages/topics.h"
#include "docent/robot/robot_config.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// Calls `on_scan(index, scan)` for every message of every laser scanner that the body has, numbered as it lists them.
template <class F>
void subscribe_scanners(transport::Bus& bus, const robot::RobotBody& body, F on_scan) {
  for (std::size_t i = 0; i < body.scanners.size(); ++i) {
    bus.subscribe<sensor_msgs::LaserScan>(topics::scan_topic(body.scanners[i].name),
                                          [i, on_scan](const sensor_msgs::LaserScan& scan) { on_scan(i, scan); });
  }
}

/// [scanners] where they are mounted.
[[nodiscard]] inline std::vector<Pose2> mounts_of(const std::vector<robot::Scanner>& scanners) {
  std::vector<Pose2> mounts;
  for (const robot::Scanner& scanner : scanners) mounts.push_back(scanner.base_from_sensor());
  return mounts;
}

}  // namespace docent::modules
