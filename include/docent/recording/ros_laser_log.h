#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/messages/message_fitness.h"
#include "docent/messages/standard_messages.h"
#include "docent/recording/laser_log.h"
#include "docent/recording/recorded_ranges.h"
#include "docent/recording/rosbag/frame_tree.h"
#include "docent/recording/rosbag/rosbag2_database.h"
#include "docent/recording/rosbag/stamp_clock.h"
#include "docent/recording/rosbag/topic_choice.h"

namespace docent::recording {

/// Makes a laser log of the messages of a ROS recording (see read_laser_log).
class RosLaserLogBuilder {
 public:
  explicit RosLaserLogBuilder(const LaserLogOptions& options = {}) : options_{options} {}  ///< nothing was added yet

  /// Messages that do not matter are passed over; those that are damaged or not fit (message_fitness.h) are left out,
  /// and a note says so.
  void add(const Rosbag2Message& message);
  /// Error: no scan was in it, or none that is fit, or what was wanted is not there. Call once.
  [[nodiscard]] Result<LaserLog> finish();

 private:
  struct Scan {
    RecordedStamp stamp;
    sensor_msgs::LaserScan message;
  };
  struct Odometry {
    RecordedStamp stamp;
    LoggedOdometry reading;
  };
  struct OdometryTopic {
    std::vector<Odometry> readings;
    std::string topic;
    std::string parent, child;  ///< frames
  };
  struct Ping {
    std::string frame;
    LoggedPing ping;
  };
  struct Refused {
    std::size_t count = 0;
    std::string first;
  };
  /// Of odometry told by transforms: the topic's name space, and behind it the prefix of the frames.
  [[nodiscard]] static std::string robot_of(const std::string& topic, const geometry_msgs::TransformStamped& transform);
  [[nodiscard]] RecordedStamp stamp_of(const std_msgs::Header& header, Time recorded) const;
  void refuse(const std::string& topic, const std::string& why);
  [[nodiscard]] std::string refused_text() const;
  [[nodiscard]] Error no_scan() const;
  template <class T>
  void add_as(const Rosbag2Message& message,
              void (RosLaserLogBuilder::*take)(const std::string& topic, T message, Time recorded));
  void take_scan(const std::string& topic, sensor_msgs::LaserScan message, Time recorded);
  void take_ping(const std::string& topic, sensor_msgs::Range message, Time recorded);
  void take_odometry(const std::string& topic, nav_msgs::Odometry message, Time recorded);
  void take_transforms(const std::string& topic, tf2_msgs::TFMessage message, Time recorded);

  [[nodiscard]] Result<void> choose();
  /// Of the topic's name space, with what those around it say.
  [[nodiscard]] FrameTree frames_of(const std::string& topic) const;
  /// The bases of robots that have an odometry.
  [[nodiscard]] std::vector<std::string> bases() const;
  /// In the order of the file's times, each message once.
  template <class T>
  void put_in_order(const std::string& topic, std::vector<T>& messages);
  void say_of_mount(const std::string& frame, const std::optional<Mount>& mount);
  void use_odometry();
  /// What no base can have driven, as when a driver begins anew at zero.
  void take_out_jumps();
  void use_scans(const std::string& topic);
  void finish_pings();
  /// The stamps of a topic, mended and without steps back.
  [[nodiscard]] std::vector<Time> followed(const std::string& name, const std::vector<RecordedStamp>& stamps);

  LaserLogOptions options_;
  std::map<std::string, std::vector<Scan>> scans_;    ///< by topic
  std::map<std::string, OdometryTopic> odometry_;     ///< by topic
  std::map<std::string, OdometryTopic> tf_odometry_;  ///< by robot_of; of several frames of one the base's
  std::map<std::string, FrameTree> frames_;           ///< by name space
  std::vector<Ping> pings_;
  std::map<std::string, Refused> refused_;     ///< by topic
  std::map<std::string, std::string> others_;  ///< topics that are not read, with their types
  RecordedRanges ranges_;                      ///< of each topic, as they stand in the recording
  ChosenTopics chosen_;
  std::string base_frame_;
  std::int64_t count_ = 0;                     ///< of messages that have a time
  std::vector<RecordedStamp> odometry_clock_;  ///< as followed
  std::vector<std::string> scan_frames_;       ///< [scans of the log]
  LaserLog log_;
};

}  // namespace docent::recording
