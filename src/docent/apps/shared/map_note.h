#pragma once

#include <string>

#include "docent/grid/occupancy_grid.h"

namespace docent::apps {

/// Says on standard error what the cells of the map in file `path` were taken for, and warns where that looks wrong.
void say_classes(const std::string& path, const OccupancyGrid& map);

}  // namespace docent::apps
