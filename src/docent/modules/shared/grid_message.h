#pragma once

#include <optional>

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

/// The grid of a message; nothing where its cells are not as many as it says.
[[nodiscard]] inline std::optional<OccupancyGrid> grid_of(const nav_msgs::OccupancyGrid& message) {
  const auto& info = message.info;
  OccupancyGrid grid;
  grid.frame = {static_cast<int>(info.width),
                static_cast<int>(info.height),
                static_cast<double>(info.resolution),
                {info.origin.position.x, info.origin.position.y}};
  if (message.data.size() != std::size_t{info.width} * info.height) return std::nullopt;
  grid.cells = message.data;
  return grid;
}

}  // namespace docent::modules
