#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/recording/rosbag/topic_choice.h"

namespace docent::recording {

inline constexpr double kLastSecond = 4294967295;  ///< [s] in the year 2106; no time of a log lies beyond it

/// One sweep of a laser scanner with the odometry of its moment, from whatever kind of recording.
struct LoggedScan {
  Time time;                  ///< of the sweep
  bool rear = false;          ///< of the rear laser
  Angle first_bearing;        ///< of ranges[0], in the laser's frame
  double bearing_step = 0.0;  ///< [rad]
  std::vector<float> ranges;  ///< [m]; +infinity: no return; NaN: an invalid reading (as REP 117 has it)
  double max_range = 0.0;     ///< [m] that this laser looks at most; 0: as LaserLog::max_range
  Pose2 odom_from_base;       ///< odometry at the moment of the scan, without its jumps
  Pose2 base_from_laser;      ///< the laser's place on the robot; the same for all scans of one laser
  Pose2 logged_pose;          ///< the other pose that CARMEN writes beside odometry, as it stands in the file
  int line = 0;               ///< where in the file; 0 for recordings without lines
  /// Of `ranges[beam]`, laser's frame.
  [[nodiscard]] Angle bearing(std::size_t beam) const {
    return Angle::radians(first_bearing.radians() + static_cast<double>(beam) * bearing_step);
  }
};

/// One reading of odometry.
struct LoggedOdometry {
  Time time;             ///< of the reading
  Pose2 odom_from_base;  ///< as logged, without its jumps
  double linear = 0.0;   ///< [m/s], as logged
  double angular = 0.0;  ///< [rad/s]
};

/// One reading of one sonar.
struct LoggedPing {
  Time time;             ///< of the reading
  int sonar = 0;         ///< index in base_from_sonar
  float range = 0.0F;    ///< [m]; +infinity: no return
  Pose2 odom_from_base;  ///< raw, at that moment
};

/// What localization and mapping need of a recording: scans with odometry, in the order of the recording.
struct LaserLog {
  std::vector<LoggedScan> scans;         ///< times never fall
  std::vector<LoggedOdometry> odometry;  ///< every odometry reading, times never fall
  std::vector<LoggedPing> pings;         ///< where they were asked for; times never fall
  std::vector<Pose2> base_from_sonar;    ///< of each sonar, in the order of their frames' names
  double sonar_max_range = 0.0;          ///< [m]
  /// PARAM lines of CARMEN.
  std::map<std::string, std::string> parameters;
  double max_range = 0.0;           ///< [m] of the laser that looks farthest: from here on a reading means "no return"
  bool times_are_invented = false;  ///< the file's times were useless: even steps of 0.2 s instead
  std::string sources;              ///< which topics of a ROS recording it was made of, in words
  /// Everything that had to be assumed or left out, in words: for a person who wonders about a result.
  std::vector<std::string> notes;
};

/// Where the times of a recording of ROS come from.
enum class LogTimes {
  stamps,  ///< of the messages; what a clock did that jumps or stands is mended
  index    ///< the order of the messages alone, in even steps: for clocks of no use
};

/// How a recording is read.
struct LaserLogOptions {
  bool with_sonars = false;  ///< also every ultrasonic sensor_msgs/Range whose frame has a place; a CARMEN log has none
  WantedTopics topics = {};  ///< of a ROS recording
  LogTimes times = LogTimes::stamps;  ///< of a ROS recording
};

/// Reads what `--log` names, by its content: a CARMEN text log (plain or gzip), an MCAP recording, a rosbag2 folder or
/// its database (.db3), packed or not, or a bag of ROS 1.
///
/// Of a ROS recording it takes the sensor_msgs/LaserScan (not those under /docent/) and the nav_msgs/Odometry of one
/// robot, or, where it has no such topic, the transform from odom of its /tf, interpolated at the scans' stamps
/// (`choose_topics`); the lasers' places come from /tf_static, or from /tf where that says them again and again. A
/// laser that hangs upside down is turned over, clockwise ones are read as they are. What 0 means, what a laser sees of
/// the robot and how far it looks is found out from the whole recording. What was chosen, mended and left out: as
/// `sources` and `notes` say.
///
/// Error: "FILE: …" or "FILE:LINE: …": unreadable, damaged, or without a scan.
[[nodiscard]] Result<LaserLog> read_laser_log(const std::filesystem::path& path, const LaserLogOptions& options = {});

}  // namespace docent::recording
