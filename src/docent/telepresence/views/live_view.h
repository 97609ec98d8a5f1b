#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/messages/driving_messages.h"
#include "docent/messages/localization_messages.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/standard_messages.h"
#include "docent/telepresence/belief_carrier.h"
#include "docent/telepresence/live_encoding.h"

namespace docent::telepresence {

/// What moves, as viewers see it: the pose and what the scanners see, the belief, the way. Old scans, people and
/// windows are shown no more.
class LiveView {
 public:
  /// @param mounts  [scanners] base_from_sensor. @param scan_step  every n-th reading is shown
  LiveView(std::vector<Pose2> mounts, int scan_step);

  void see(const nav_msgs::Odometry& odometry) { carrier_.add_odometry(odometry); }
  /// @pre scanner < mounts.size()
  void see_scan(std::size_t scanner, const sensor_msgs::LaserScan& scan) { scans_[scanner] = scan; }
  void mount(std::size_t scanner, const Pose2& base_from_sensor) { mounts_[scanner] = base_from_sensor; }
  void see(const sensor_msgs::BatteryState& battery) { battery_ = battery.percentage; }
  void see(const docent_msgs::People& people) { people_ = people; }
  void see(const docent_msgs::Belief& belief);
  void see(const docent_msgs::AvoidState& state) { avoid_ = state; }
  void see(const nav_msgs::Path& path);
  void see(const docent_msgs::GoalState& state);

  /// Everything that moves, and of the same moment the pose alone.
  [[nodiscard]] std::string live(Time now) const;
  [[nodiscard]] std::string pose(Time now) const { return encode_pose(frame(now)); }
  /// nullopt: as before.
  [[nodiscard]] std::optional<std::string> belief();
  [[nodiscard]] std::optional<std::string> path();

  [[nodiscard]] std::optional<Pose2> map_from_base(Time now) const { return carrier_.map_from_base(now); }
  [[nodiscard]] const docent_msgs::People& people() const { return people_; }

 private:
  /// Where the robot is, and how fast.
  [[nodiscard]] LiveFrame frame(Time now) const;
  void add_scans(LiveFrame& frame) const;

  std::vector<Pose2> mounts_;
  const std::size_t scan_step_;
  BeliefCarrier carrier_;
  std::vector<sensor_msgs::LaserScan> scans_;  ///< [scanners] newest sweeps
  docent_msgs::People people_;
  std::optional<docent_msgs::Belief> belief_;  ///< not yet shown
  std::optional<docent_msgs::AvoidState> avoid_;
  std::optional<double> battery_;
  nav_msgs::Path path_;
  docent_msgs::GoalState goal_;
  bool is_path_new_ = false;
};

}  // namespace docent::telepresence
