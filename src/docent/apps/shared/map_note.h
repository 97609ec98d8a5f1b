#pragma once

#include <string>
#include <vector>

#include "docent/grid/occupancy_grid.h"

namespace docent::apps {

/// Says on standard error what the cells of the map in file `path` were taken for and what is odd about the file, and
/// warns where that looks wrong.
void say_classes(const std::string& path, const OccupancyGrid& map, const std::vector<std::string>& notes);
/// The map of that file, and says so. CommandFailed where it cannot be read.
[[nodiscard]] OccupancyGrid load_and_say(const std::string& path);

}  // namespace docent::apps
