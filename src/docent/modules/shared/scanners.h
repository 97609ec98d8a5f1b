#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include "docent/messages/conversions.h"
#include "docent/messages/topics.h"
#include "docent/robot/robot_config.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// Calls `on_scan(index, scan)` for every message of every laser scanner that the body has, numbered as it lists them,
/// as it comes from the driver.
template <class F>
void subscribe_raw_scanners(transport::Bus& bus, const robot::RobotBody& body, F on_scan) {
  for (std::size_t i = 0; i < body.scanners.size(); ++i) {
    bus.subscribe<sensor_msgs::LaserScan>(topics::scan_topic(body.scanners[i].name),
                                          [i, on_scan](const sensor_msgs::LaserScan& scan) { on_scan(i, scan); });
  }
}

/// Where a scanner is mounted and how late its stamps are, as far as is known now.
struct ScannerPlace {
  Pose2 base_from_sensor;
  double delay = 0.0;  ///< [s] that was taken from the stamp of the scan
};

/// [scanners] where they are mounted, as robot.yaml says.
[[nodiscard]] inline std::vector<Pose2> mounts_of(const std::vector<robot::Scanner>& scanners) {
  std::vector<Pose2> mounts;
  for (const robot::Scanner& scanner : scanners) mounts.push_back(scanner.base_from_sensor());
  return mounts;
}

/// The places of all scanners: as robot.yaml has them until the module `calibrate` says otherwise.
[[nodiscard]] inline std::shared_ptr<const std::vector<ScannerPlace>> follow_calibration(transport::Bus& bus,
                                                                                         const robot::RobotBody& body) {
  auto places = std::make_shared<std::vector<ScannerPlace>>();
  std::vector<std::string> names;
  for (const robot::Scanner& scanner : body.scanners) {
    places->push_back({scanner.base_from_sensor(), 0.0});
    names.push_back(scanner.name);
  }
  bus.subscribe<docent_msgs::Calibration>(topics::kCalibration, [places, names](const auto& calibration) {
    for (const docent_msgs::CalibratedMount& mount : calibration.mounts) {
      for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == mount.scanner) (*places)[i] = {{mount.x, mount.y, Angle::radians(mount.heading)}, mount.delay};
    }
  });
  return places;
}

/// Calls `on_scan(index, scan, place)`, or `on_scan(index, scan)`, for every message of every laser scanner that the
/// body has, numbered as it lists them; with the stamp of the moment that it is of, as far as that is known.
template <class F>
void subscribe_scanners(transport::Bus& bus, const robot::RobotBody& body, F on_scan) {
  const auto tell = [on_scan](std::size_t i, const sensor_msgs::LaserScan& scan, const ScannerPlace& place) {
    if constexpr (std::is_invocable_v<F, std::size_t, const sensor_msgs::LaserScan&, const ScannerPlace&>)
      on_scan(i, scan, place);
    else
      on_scan(i, scan);
  };
  subscribe_raw_scanners(
      bus, body, [tell, places = follow_calibration(bus, body)](std::size_t i, const sensor_msgs::LaserScan& scan) {
        const ScannerPlace& place = (*places)[i];
        if (place.delay == 0.0) return tell(i, scan, place);
        sensor_msgs::LaserScan earlier = scan;
        earlier.header.stamp = to_message(from_message(scan.header.stamp) - seconds(place.delay));
        tell(i, earlier, place);
      });
}

}  // namespace docent::modules
