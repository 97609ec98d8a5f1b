#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "docent/messages/create3/hazard_reading.h"
#include "docent/transport/bus.h"

namespace docent::modules {

/// Tells what a Create 3, the base of the TurtleBot 4, says of hazards in the words of every base: its bumpers on
/// `tactile`, edges of the floor on `obstacle_lines`. A base that falls silent is a silent ring, and the robot stands.
class Create3Hazards {
 public:
  /// @param radius  [m] of the body
  Create3Hazards(transport::Bus& bus, double radius);
  Create3Hazards(const Create3Hazards&) = delete;  // the subscriptions hold `this`
  Create3Hazards& operator=(const Create3Hazards&) = delete;

  /// What is wrong, for the module's health; empty: nothing.
  [[nodiscard]] std::string complaint() const;

 private:
  void read(const irobot_create_msgs::HazardDetectionVector& hazards);

  transport::Bus& bus_;
  HazardReader reader_;
  transport::Publisher<docent_msgs::Tactile> tactile_;
  transport::Publisher<docent_msgs::ObstacleLines> lines_;
  Pose2 odom_from_base_;
  double speed_ = 0.0;
  bool is_kidnapped_ = false;
  bool is_lifted_ = false;
  std::optional<Time> heard_;
  std::optional<Time> told_at_;
  std::vector<std::uint8_t> told_;  ///< segments, last
  std::size_t edges_told_ = 0;
  std::uint32_t count_ = 0;  ///< of readings of the ring that were told
};

}  // namespace docent::modules
