#pragma once

#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"
#include "docent/recording/rosbag/frame_tree.h"
#include "docent/robot/robot_config.h"

namespace docent::modules {

/// From when on what the base and robot.yaml say of a scanner's mount are two things, as in module `calibrate`.
struct BaseMountsParams {
  double position = 0.03;  ///< [m]
  double heading = 1.5;    ///< [deg]
};

/// Where the base's own transforms say that its scanners are: for those of which robot.yaml says no x, y and heading,
/// and to compare for all others. The transforms that the robot publishes itself count as nobody's.
class BaseMounts {
 public:
  explicit BaseMounts(const robot::RobotBody& body, const BaseMountsParams& params = {});

  /// From tf_static.
  void hear_static(const tf2_msgs::TFMessage& transforms);
  /// From tf: some drivers send there again and again what never changes.
  void hear(const tf2_msgs::TFMessage& transforms);

  /// Gives the scanners without a mount what the base says. @returns of which it says nothing, for a person; empty: of
  /// all that was wanted
  [[nodiscard]] std::string set_in(robot::RobotConfig& config) const;
  /// What the base says otherwise than robot.yaml, for a person; empty: nothing.
  [[nodiscard]] std::string contradictions() const;
  /// The mounts that robot.yaml says, or, `of_base`, those that it leaves to the base, as transforms without a stamp.
  [[nodiscard]] tf2_msgs::TFMessage transforms(bool of_base) const;

 private:
  [[nodiscard]] bool is_own(const geometry_msgs::TransformStamped& transform) const;

  std::vector<robot::Scanner> scanners_;
  BaseMountsParams params_;
  tf2_msgs::TFMessage own_;  ///< what the robot publishes
  recording::FrameTree frames_;
};

/// Whether robot.yaml leaves the mount of any scanner to the base.
[[nodiscard]] bool wants_mounts_of_base(const robot::RobotBody& body);

}  // namespace docent::modules
