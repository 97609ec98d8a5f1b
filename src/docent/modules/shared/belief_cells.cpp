#include "docent/modules/shared/belief_cells.h"

#include "docent/messages/conversions.h"

namespace docent::modules {

docent_msgs::Belief belief_cells_message(const localization::BeliefSummary& summary, Time stamp) {
  docent_msgs::Belief message;
  message.header = {to_message(stamp), "map"};
  message.cells.reserve(summary.cells.size());
  for (const auto& cell : summary.cells) message.cells.push_back({cell.x, cell.y, cell.theta, cell.mass});
  for (const localization::BeliefMode& mode : summary.modes) {
    const Pose2& pose = mode.map_from_robot;
    message.hypotheses.push_back({pose.x, pose.y, pose.theta.radians(), mode.covariance, mode.mass});
  }
  return message;
}

}  // namespace docent::modules
