#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"
#include "docent/recording/laser_log.h"
#include "docent/recording/rosbag2_database.h"

namespace docent {

/// Makes a laser log of the messages of a ROS 2 recording (see read_laser_log).
class RosLaserLogBuilder {
 public:
  explicit RosLaserLogBuilder(bool with_sonars = false) : with_sonars_{with_sonars} {}

  /// Messages that do not matter are passed over. Error: a message that does not decode.
  [[nodiscard]] Result<void> add(const Rosbag2Message& message);
  /// Error: no scan was in it. Call once.
  [[nodiscard]] Result<LaserLog> finish();

 private:
  struct Scan {
    Time time;
    std::string frame;
    LoggedScan scan;
  };
  struct Mount {
    Pose2 base_from_laser;
    bool is_upside_down = false;
  };
  struct Ping {
    std::string frame;
    LoggedPing ping;
  };
  void add_scan(const sensor_msgs::LaserScan& message, Time log_time);
  void add_ping(const sensor_msgs::Range& message, Time log_time);
  void finish_pings();
  [[nodiscard]] std::optional<Mount> mount_of(const std::string& frame) const;
  [[nodiscard]] Pose2 odometry_at(Time time) const;

  bool with_sonars_;
  std::vector<Scan> scans_;
  std::vector<Ping> pings_;
  std::map<std::string, std::vector<LoggedOdometry>> odometry_;               ///< by topic
  std::map<std::string, std::string> base_frames_;                            ///< by odometry topic
  std::map<std::string, geometry_msgs::TransformStamped> static_transforms_;  ///< by child frame
  std::string base_frame_;
  LaserLog log_;
};

}  // namespace docent
