#pragma once

#include <string>

#include "docent/collision_avoidance/clocks/driver_stamps.h"
#include "docent/collision_avoidance/clocks/local_time.h"
#include "docent/messages/conversions.h"
#include "docent/modules/shared/scanners.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// When the readings were taken that come, by local time: clocks of other computers are apart, drift and are set, some
/// drivers stamp late or not at all. One for each module; a module that compares readings of several sensors gives it
/// all of them.
class SensorTime {
 public:
  explicit SensorTime(const transport::Bus& bus) : bus_{bus} {}

  [[nodiscard]] Time of(const nav_msgs::Odometry& odometry) {
    const Time now = bus_.now();
    const bool stands = odometry.twist.twist.linear.x == 0.0 && odometry.twist.twist.angular.z == 0.0;
    const Time stamp =
        odometry_.mend(now, from_message(odometry.header.stamp), from_message(odometry.pose.pose), stands);
    return local_.receive("odometry", now, stamp);
  }
  /// As the scanner's clock has it.
  [[nodiscard]] Time of(std::size_t scanner, const sensor_msgs::LaserScan& scan) {
    return of("laser " + std::to_string(scanner), scan.header);
  }
  /// As odometry's clock has it, as far as `calibrate` has found out by how much the scanner's stamps are late.
  [[nodiscard]] Time of(std::size_t scanner, const sensor_msgs::LaserScan& scan, const ScannerPlace& place) {
    return of(scanner, scan) - seconds(place.delay);
  }
  /// @param source  one name for each driver that stamps, the same in all modules: "sonars", "infrared", "tactile"
  [[nodiscard]] Time of(const std::string& source, const std_msgs::Header& header) {
    const Time now = bus_.now();
    return local_.receive(source, now, collision_avoidance::stamp_or(from_message(header.stamp), now));
  }

 private:
  const transport::Bus& bus_;
  collision_avoidance::LocalTime local_;
  collision_avoidance::OdometryStamps odometry_;
};

}  // namespace docent::modules
