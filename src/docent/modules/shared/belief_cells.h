#pragma once

#include "docent/base/time.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/messages/docent_messages.h"

namespace docent::modules {

/// Belief::map_hash of a robot that is making its map.
inline constexpr const char* kMapBeingMade = "exploration";

/// The listed cells and the modes of a belief, in the frame `map`; nothing of its rest. O(cells).
[[nodiscard]] docent_msgs::Belief belief_cells_message(const localization::BeliefSummary& summary, Time stamp);

}  // namespace docent::modules
