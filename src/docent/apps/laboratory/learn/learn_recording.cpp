#include "docent/apps/laboratory/learn/learn_recording.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace docent::apps::learn_command {

namespace {

constexpr double kStepWay = 0.03;   // [m]
constexpr double kStepTurn = 2.0;   // [deg]
constexpr double kStepTime = 0.5;   // [s]
constexpr double kMinRange = 0.02;  // [m]

/// Lasers are told apart by their places.
int sensor_at(std::vector<Pose2>& places, const Pose2& base_from_laser) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Pose2& at = places[i];
    if (distance(at.position(), base_from_laser.position()) < 1e-4 &&
        std::abs((at.theta - base_from_laser.theta).radians()) < 1e-4)
      return static_cast<int>(i);
  }
  places.push_back(base_from_laser);
  return static_cast<int>(places.size()) - 1;
}

}  // namespace

localization::LearningRecording learning_recording(const recording::LaserLog& log, double reach, bool with_sonars) {
  localization::LearningRecording recording;
  std::vector<Pose2> lasers;
  std::map<int, std::size_t> last;  // kept sweep by laser
  for (const recording::LoggedScan& scan : log.scans) {
    localization::RecordedSweep sweep;
    sweep.time = scan.time;
    sweep.sensor = sensor_at(lasers, scan.base_from_laser);
    sweep.odom_from_base = scan.odom_from_base;
    sweep.base_from_sensor = scan.base_from_laser;
    if (const auto before = last.find(sweep.sensor); before != last.end()) {
      const localization::RecordedSweep& kept = recording.lasers[before->second];
      const Pose2 moved = inverse(kept.odom_from_base) * sweep.odom_from_base;
      if (norm(moved.position()) < kStepWay && std::abs(moved.theta.degrees()) < kStepTurn &&
          to_seconds(sweep.time - kept.time) < kStepTime)
        continue;
    }
    last[sweep.sensor] = recording.lasers.size();
    const double own_reach = scan.max_range > 0.0 ? std::min(scan.max_range, reach) : reach;
    sensor_models::append(sweep.sweep, {scan.ranges, scan.first_bearing, scan.bearing_step, kMinRange, own_reach}, {});
    recording.lasers.push_back(std::move(sweep));
  }
  if (!with_sonars) return recording;
  for (const recording::LoggedPing& ping : log.pings) {
    const bool no_return = !(static_cast<double>(ping.range) < log.sonar_max_range);
    const double range = no_return ? log.sonar_max_range : static_cast<double>(ping.range);
    recording.sonars.push_back({ping.time,
                                ping.sonar,
                                ping.odom_from_base,
                                log.base_from_sonar[static_cast<std::size_t>(ping.sonar)],
                                {{{0.0, range, no_return}}}});
  }
  return recording;
}

}  // namespace docent::apps::learn_command
