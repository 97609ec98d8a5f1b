#pragma once

namespace CLI {
class App;
}

namespace docent::apps::map_ceiling_command {

/// `docent map-ceiling`: a mosaic of the ceiling, of pictures that the robot took on a drive.
void add_map_ceiling_command(CLI::App& app);

}  // namespace docent::apps::map_ceiling_command
