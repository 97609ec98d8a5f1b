#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/messages/message_fitness.h"
#include "docent/messages/standard_messages.h"
#include "docent/recording/laser_log.h"
#include "docent/recording/log_odometry.h"
#include "docent/recording/recorded_ranges.h"
#include "docent/recording/rosbag2_database.h"

namespace docent::recording {

/// Makes a laser log of the messages of a ROS 2 recording (see read_laser_log).
class RosLaserLogBuilder {
 public:
  explicit RosLaserLogBuilder(bool with_sonars = false) : with_sonars_{with_sonars} {}  ///< with_sonars: pings, too

  /// Messages that do not matter are passed over; those that are not fit (message_fitness.h) are left out, and a note
  /// says so. Error: a message that does not decode.
  [[nodiscard]] Result<void> add(const Rosbag2Message& message);
  /// Error: no scan was in it, or none that is fit. Call once.
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
  struct Refused {
    std::size_t count = 0;
    MessageFault first;
  };
  /// Whether the message is fit, and can be used so; counts those that are not.
  template <class T>
  [[nodiscard]] bool admits(const T& content, const std::string& topic);
  void refuse(const std::string& topic, const MessageFault& fault);
  [[nodiscard]] std::string refused_text() const;
  void add_odometry(const geometry_msgs::TransformStamped& transform, Time log_time);
  void add_scan(const sensor_msgs::LaserScan& message, Time log_time);
  void add_ping(const sensor_msgs::Range& message, Time log_time);
  void finish_pings();
  /// nullopt: nobody says it, or it lies far off any robot.
  [[nodiscard]] std::optional<Mount> mount_of(const std::string& frame) const;
  [[nodiscard]] Pose2 odometry_at(Time time) const;
  /// What no base can have driven, as when a driver begins anew at zero.
  void take_out_jumps();

  bool with_sonars_;
  std::map<std::string, RisingStamps> stamps_;  ///< by odometry topic and by frame of a scanner
  std::vector<Scan> scans_;
  std::vector<Ping> pings_;
  std::map<std::string, std::vector<LoggedOdometry>> odometry_;               ///< by topic
  std::map<std::string, std::string> base_frames_;                            ///< by odometry topic
  std::map<std::string, geometry_msgs::TransformStamped> static_transforms_;  ///< by child frame
  std::string base_frame_;
  std::vector<LoggedOdometry> tf_odometry_;  ///< of a recording without any odometry topic
  std::string tf_base_frame_;
  std::map<std::string, Refused> refused_;  ///< by topic
  RecordedRanges ranges_;                   ///< of each topic, as they stand in the recording
  LaserLog log_;
};

}  // namespace docent::recording
