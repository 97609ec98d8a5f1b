#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "docent/apps/doctor/findings.h"
#include "docent/apps/doctor/stream_watch.h"
#include "docent/messages/topics.h"
#include "docent/modules/shared/scanners.h"
#include "docent/recording/rosbag/frame_tree.h"
#include "docent/robot/robot_config.h"
#include "docent/transport/bus.h"

namespace docent::apps::doctor_command {

/// Of what kind the base is, beside what `body` says.
struct BaseKind {
  bool is_create3 = false;       ///< bumpers come on hazard_detection
  bool docks_by_action = false;  ///< it has a dock of its own
};

/// Listens to all that a robot of this configuration wants of its base. It publishes nothing.
class Sensors {
 public:
  Sensors(transport::Bus& bus, const robot::RobotBody& body, const BaseKind& kind);
  Sensors(const Sensors&) = delete;  // the subscriptions hold `this`
  Sensors& operator=(const Sensors&) = delete;

  /// After some seconds of listening, since `begin`.
  [[nodiscard]] std::vector<Finding> findings(Time begin);
  /// A robot of Docent's runs in this domain.
  [[nodiscard]] bool robot_runs() const { return !modules_.empty(); }

 private:
  struct Scan {
    StreamWatch watch;
    sensor_msgs::LaserScan newest;
    double failed_share = 0.0;  ///< of the newest
    double median = 0.0;        ///< [m] of what came back, likewise
  };
  void listen();
  void listen_to_create3();
  void hear_scan(std::size_t i, const sensor_msgs::LaserScan& written);
  void judge_scans(std::vector<Finding>& all, Time begin);
  void judge_odometry(std::vector<Finding>& all, Time begin);
  void judge_ring(std::vector<Finding>& all, const std::string& name, int wanted,
                  const std::map<std::string, StreamWatch>& heard, const transport::TopicInfo& topic,
                  const StreamDemand& demand, Time begin);
  void judge_battery(std::vector<Finding>& all, Time begin);
  void judge_commands(std::vector<Finding>& all);
  void judge_mount(Finding& finding, const robot::Scanner& scanner) const;
  template <class T>
  [[nodiscard]] int writers(const Topic<T>& topic) {
    return bus_.other_writers(transport::topic_info(topic));
  }

  transport::Bus& bus_;
  robot::RobotBody body_;
  BaseKind kind_;
  std::vector<Scan> scans_;
  modules::ScannerReaders readers_;
  StreamWatch odometry_, battery_, tactile_, hazards_, dock_;
  nav_msgs::Odometry last_odometry_;
  double fastest_ = 0.0;  ///< [m/s] that odometry tells
  sensor_msgs::BatteryState last_battery_;
  std::map<std::string, StreamWatch> sonars_, infrareds_;
  recording::FrameTree frames_;
  bool has_transforms_ = false;                 ///< somebody sends tf_static
  std::map<std::string, std::string> modules_;  ///< of a robot that runs: their states
};

}  // namespace docent::apps::doctor_command
