#pragma once

#include <utility>

#include "docent/messages/driving_messages.h"
#include "docent/messages/message_fitness.h"

namespace docent {

/// A target as it may be sent: one that stands still, where a number of it is none of this world. An odometry that has
/// gone mad puts ways there.
[[nodiscard]] inline docent_msgs::Target fit_target(docent_msgs::Target target) {
  if (!fault_of_fields(target)) return target;
  docent_msgs::Target standing;
  standing.header = std::move(target.header);
  standing.goal_id = std::move(target.goal_id);
  standing.mode = "stop";
  return standing;
}

}  // namespace docent
