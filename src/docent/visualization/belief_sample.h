#pragma once

#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/messages/docent_messages.h"

namespace docent::visualization {

/// `count` poses that lie as the belief does: each stands for the same mass. Within its cell, a sample's place comes
/// from a sequence that fills the cell evenly and is the same each time. Empty when the belief holds no mass. O(cells +
/// count). @pre count >= 0
[[nodiscard]] std::vector<Pose2> belief_sample(const docent_msgs::Belief& belief, int count);

}  // namespace docent::visualization
