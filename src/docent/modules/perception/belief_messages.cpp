#include "docent/modules/perception/belief_messages.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "docent/messages/conversions.h"
#include "docent/modules/shared/belief_cells.h"

namespace docent::modules {

docent_msgs::CoarseBelief rest_message(const localization::BeliefSummary& summary) {
  return {static_cast<float>(summary.rest_origin.x),     static_cast<float>(summary.rest_origin.y),
          static_cast<float>(summary.rest_cell_size),    static_cast<std::uint32_t>(summary.rest_columns),
          static_cast<std::uint32_t>(summary.rest_rows), summary.rest};
}

docent_msgs::Belief belief_message(const localization::BeliefSummary& summary, Time stamp) {
  docent_msgs::Belief message = belief_cells_message(summary, stamp);
  message.rest = rest_message(summary);
  message.entropy = summary.entropy;
  message.active_mass = summary.active_mass;
  message.active_cells = static_cast<std::uint32_t>(summary.active_states);
  return message;
}

void add_verdict(docent_msgs::Belief& message, const localization::Verdict& verdict) {
  message.p_lost = verdict.p_lost();
  message.agreement = static_cast<float>(verdict.agreement());
  message.contradiction = static_cast<float>(verdict.contradiction());
  message.surprise = static_cast<float>(verdict.surprise());
  message.hidden = static_cast<float>(verdict.hidden());
  message.confirmation = static_cast<float>(verdict.confirmation());
  message.blind_way = static_cast<float>(verdict.blind_way());
  message.unmapped = static_cast<float>(verdict.unmapped());
  message.share = static_cast<float>(verdict.share());
}

tf2_msgs::TFMessage odom_in_map_message(const Pose2& map_from_odom, Time stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header = {to_message(stamp), "map"};
  transform.child_frame_id = "odom";
  transform.transform = {{map_from_odom.x, map_from_odom.y, 0.0}, to_quaternion(map_from_odom.theta)};
  tf2_msgs::TFMessage message;
  message.transforms.push_back(std::move(transform));
  return message;
}

geometry_msgs::PoseWithCovarianceStamped pose_message(const localization::BeliefMode& mode, Time stamp) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header = {to_message(stamp), "map"};
  message.pose.pose = to_message(mode.map_from_robot);
  constexpr std::array<std::size_t, 3> kAxes{0, 1, 5};  // x, y, yaw of six
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) message.pose.covariance[kAxes[i] * 6 + kAxes[j]] = mode.covariance[i * 3 + j];
  return message;
}

}  // namespace docent::modules
