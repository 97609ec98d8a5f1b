#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include "docent/messages/conversions.h"
#include "docent/messages/scanners/scan_reader.h"
#include "docent/messages/topics.h"
#include "docent/robot/robot_config.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// One reader for each laser scanner of a body, numbered as it lists them. Every module has its own.
class ScannerReaders {
 public:
  explicit ScannerReaders(const robot::RobotBody& body);

  /// The sweep of a scanner as all of Docent reads it (`ScanReader`): counter-clockwise as the robot
  /// stands, greatest range: nothing came back, NaN: no reading. O(beams)
  [[nodiscard]] sensor_msgs::LaserScan read(std::size_t scanner, const sensor_msgs::LaserScan& scan);
  /// [beams] those of the scanner's newest sweep that ended on the robot itself; empty: none did.
  [[nodiscard]] const std::vector<bool>& own_body(std::size_t scanner) const { return readers_[scanner].own_body(); }
  /// What a technician should know of the scanners: "scan_front writes 0 where …; …"; empty: nothing.
  [[nodiscard]] std::string notes() const;
  /// What of their sight keeps a robot from finding its place, likewise.
  [[nodiscard]] std::string hindrances() const;

 private:
  std::vector<std::string> topics_;
  std::vector<ScanReader> readers_;
};

/// Calls `on_scan(index, scan)` for every sweep of every laser scanner that the body has, as ScannerReaders::read gives
/// it, with the stamp that the driver gave it.
/// @returns who reads them
template <class F>
std::shared_ptr<const ScannerReaders> subscribe_stamped_scanners(transport::Bus& bus, const robot::RobotBody& body,
                                                                 F on_scan) {
  const auto readers = std::make_shared<ScannerReaders>(body);
  for (std::size_t i = 0; i < body.scanners.size(); ++i) {
    bus.subscribe<sensor_msgs::LaserScan>(
        topics::scan_topic(body.scanners[i].name),
        [i, on_scan, readers](const sensor_msgs::LaserScan& scan) { on_scan(i, readers->read(i, scan)); });
  }
  return readers;
}

/// Where a scanner is mounted and how late its stamps are, as far as is known now.
struct ScannerPlace {
  Pose2 base_from_sensor;
  double delay = 0.0;  ///< [s] by which the stamps are later than the sweeps, in local time
};

/// [scanners] where they are mounted, as robot.yaml says.
[[nodiscard]] std::vector<Pose2> mounts_of(const std::vector<robot::Scanner>& scanners);

/// The places of all scanners: as robot.yaml has them until the module `calibrate` says otherwise.
[[nodiscard]] std::shared_ptr<const std::vector<ScannerPlace>> follow_calibration(transport::Bus& bus,
                                                                                  const robot::RobotBody& body);

/// Calls `on_scan(index, scan, place)`, or `on_scan(index, scan)`, for every sweep of every laser scanner that the body
/// has, as ScannerReaders::read gives it. SensorTime tells of which moment it is.
/// @returns who reads them
template <class F>
std::shared_ptr<const ScannerReaders> subscribe_scanners(transport::Bus& bus, const robot::RobotBody& body, F on_scan) {
  const auto tell = [on_scan](std::size_t i, const sensor_msgs::LaserScan& scan, const ScannerPlace& place) {
    if constexpr (std::is_invocable_v<F, std::size_t, const sensor_msgs::LaserScan&, const ScannerPlace&>)
      on_scan(i, scan, place);
    else
      on_scan(i, scan);
  };
  return subscribe_stamped_scanners(
      bus, body, [tell, places = follow_calibration(bus, body)](std::size_t i, const sensor_msgs::LaserScan& scan) {
        tell(i, scan, (*places)[i]);
      });
}

}  // namespace docent::modules
