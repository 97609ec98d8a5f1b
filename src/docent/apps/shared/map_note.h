#pragma once

#include <string>
#include <vector>

#include "docent/grid/map_reading.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/museum/museum.h"

namespace docent::apps {

/// Says on standard error how far the reading of that map is, where it takes more than some seconds.
[[nodiscard]] ReadingProgress reading_of(const std::string& path);
/// Says on standard error what the cells of the map in file `path` were taken for and what is odd about the file, and
/// warns where that looks wrong.
void say_classes(const std::string& path, const OccupancyGrid& map, const std::vector<std::string>& notes);
/// The map of that file, and says so. CommandFailed where it cannot be read.
[[nodiscard]] OccupancyGrid load_and_say(const std::string& path);
/// The same of a museum's map; a museum without one, as before it is explored, has nothing to say.
void say_map(const museum::Museum& museum);
/// The museum of that folder, and says what its map was taken for. CommandFailed where it cannot be read.
museum::Museum load_museum_and_say(const std::string& folder);

}  // namespace docent::apps
