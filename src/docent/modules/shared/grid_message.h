#pragma once

#include "docent/grid/occupancy_grid.h"
#include "docent/messages/conversions.h"
#include "docent/messages/standard_messages.h"

namespace docent::modules {

/// Where the cells of a grid lie, in a message.
[[nodiscard]] inline nav_msgs::MapMetaData info_of(const GridFrame& frame, Time now) {
  nav_msgs::MapMetaData info;
  info.map_load_time = to_message(now);
  info.resolution = static_cast<float>(frame.resolution);
  info.width = static_cast<std::uint32_t>(frame.columns);
  info.height = static_cast<std::uint32_t>(frame.rows);
  info.origin = to_message(Pose2{frame.origin.x, frame.origin.y, {}});
  return info;
}

}  // namespace docent::modules
