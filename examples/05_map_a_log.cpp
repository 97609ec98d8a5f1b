// From a log to a map: poses of all scans by matching them and closing loops, then evidence of each scan in each cell.
// Reads CARMEN logs, MCAP and rosbag2; without an argument it maps a log that it has written itself, and compares.
#include <docent/mapping/graph_mapping/graph_mapper.h>
#include <docent/mapping/occupancy/scan_mapper.h>
#include <docent/recording/laser_log.h>

#include <string>
#include <vector>

#include "simulated_log.h"

namespace mapping = docent::mapping;
int main(int argc, char** argv) {
  const std::string logged = example::argument_or_exit(argc, argv, "LOG", "");
  std::vector<docent::Pose2> truth;
  const docent::recording::LaserLog log = example::value_or_exit(
      docent::recording::read_laser_log(logged.empty() ? example::write_log(DOCENT_MUSEUM, truth) : logged));
  for (const std::string& note : log.notes) std::printf("note: %s\n", note.c_str());

  // What mapping takes: points on surfaces, in the robot's frame, with odometry. One scan every 25 cm is enough.
  std::vector<mapping::MappingScan> scans;
  std::vector<mapping::PlacedSweep> sweeps;
  for (std::size_t i = 0; i < log.scans.size(); ++i) {
    const docent::recording::LoggedScan& scan = log.scans[i];
    const auto moved =
        scans.empty() ? docent::Pose2{1.0, 0.0, {}} : inverse(scans.back().odom_from_base) * scan.odom_from_base;
    if (docent::norm(moved.position()) < 0.25 && std::abs(moved.theta.degrees()) < 15.0) continue;
    docent::sensor_models::RangeSweep sweep;
    docent::sensor_models::append(sweep, {scan.ranges, scan.first_bearing, scan.bearing_step, 0.02, log.max_range}, {});
    mapping::MappingScan taken{scan.odom_from_base, {}, {scan.base_from_laser.position()}};
    for (const auto& point : mapping::surface_points(sweep, {}))
      taken.points.push_back(mapping::transformed(scan.base_from_laser, point));
    scans.push_back(std::move(taken));
    sweeps.push_back({std::move(sweep), scan.base_from_laser});
    if (logged.empty()) truth[scans.size() - 1] = truth[i];
  }

  const mapping::GraphMap poses = mapping::map_by_graph(scans, {});
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    sweeps[i].map_from_sensor = poses.map_from_base[i] * sweeps[i].map_from_sensor;
  const mapping::ScanMapperParams params;
  mapping::ScanMapper mapper{example::value_or_exit(mapping::ScanMapper::frame_of(sweeps, params)), params};
  for (const auto& sweep : sweeps) mapper.add(sweep);
  example::value_or_exit(docent::save_map(mapper.map(), "mapped"));
  std::printf("%zu of %zu scans, %zu loops closed; mapped.yaml, mapped.pgm. %s\n", scans.size(), log.scans.size(),
              poses.loops, poses.judgement.is_trusted ? "The map can be trusted" : poses.judgement.reason.c_str());
  if (!logged.empty()) return 0;

  double by_odometry = 0.0, by_map = 0.0;  // [m] mean, of poses seen from the first one
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const docent::Point2 wanted = (inverse(truth[0]) * truth[i]).position();
    const docent::Pose2 logged = inverse(scans[0].odom_from_base) * scans[i].odom_from_base;
    const docent::Pose2 mapped = inverse(poses.map_from_base[0]) * poses.map_from_base[i];
    by_odometry += distance(logged.position(), wanted) / static_cast<double>(scans.size());
    by_map += distance(mapped.position(), wanted) / static_cast<double>(scans.size());
  }
  std::printf("Mean error of the poses: %.2f m by odometry, %.3f m by the map\n", by_odometry, by_map);
  return by_map < 0.10 && by_map < 0.25 * by_odometry ? 0 : 1;
}
