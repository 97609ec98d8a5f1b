#include "docent/modules/shared/scanners.h"

namespace docent::modules {
namespace {

ScannerTraits traits_of(const robot::RobotBody& body, const robot::Scanner& scanner) {
  ScannerTraits traits;
  traits.base_from_sensor = scanner.base_from_sensor();
  traits.is_upside_down = scanner.upside_down;
  traits.max_range = scanner.max_range;
  traits.zero = scanner.zero == "nothing"  ? ZeroMeans::nothing
                : scanner.zero == "failed" ? ZeroMeans::failed
                                           : ZeroMeans::find_out;
  traits.body_radius = body.radius;
  for (const auto& corner : body.outline) traits.body_outline.push_back({corner[0], corner[1]});
  return traits;
}

}  // namespace

ScannerReaders::ScannerReaders(const robot::RobotBody& body) {
  for (const robot::Scanner& scanner : body.scanners) {
    topics_.push_back(body.topic_of(scanner));
    readers_.emplace_back(traits_of(body, scanner));
  }
}

sensor_msgs::LaserScan ScannerReaders::read(std::size_t scanner, const sensor_msgs::LaserScan& scan) {
  const DriverScan& read = readers_[scanner].read(
      {scan.ranges, static_cast<double>(scan.angle_min), static_cast<double>(scan.angle_increment),
       static_cast<double>(scan.range_min), static_cast<double>(scan.range_max)});
  sensor_msgs::LaserScan result;
  result.header = scan.header;
  result.angle_min = static_cast<float>(read.first_bearing);
  result.angle_increment = static_cast<float>(read.bearing_step);
  result.angle_max =
      static_cast<float>(read.first_bearing + read.bearing_step * (static_cast<double>(read.ranges.size()) - 1.0));
  result.time_increment = scan.time_increment;
  result.scan_time = scan.scan_time;
  result.range_min = scan.range_min;
  result.range_max = static_cast<float>(read.max_range);
  result.ranges.assign(read.ranges.begin(), read.ranges.end());
  return result;
}

std::string ScannerReaders::notes() const {
  std::string text;
  for (std::size_t i = 0; i < readers_.size(); ++i)
    for (const std::string& note : readers_[i].notes()) text += (text.empty() ? "" : "; ") + topics_[i] + " " + note;
  return text;
}

std::string ScannerReaders::hindrances() const {
  std::string text;
  for (std::size_t i = 0; i < readers_.size(); ++i)
    if (const std::string what = readers_[i].hindrance(); !what.empty())
      text += (text.empty() ? "" : "; ") + topics_[i] + " " + what;
  return text;
}

std::vector<Pose2> mounts_of(const std::vector<robot::Scanner>& scanners) {
  std::vector<Pose2> mounts;
  for (const robot::Scanner& scanner : scanners) mounts.push_back(scanner.base_from_sensor());
  return mounts;
}

std::shared_ptr<const std::vector<ScannerPlace>> follow_calibration(transport::Bus& bus, const robot::RobotBody& body) {
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

}  // namespace docent::modules
