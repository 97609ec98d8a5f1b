#pragma once

namespace CLI {
class App;
}

namespace docent::apps::calibrate_camera_command {

/// `docent calibrate-camera`: a lens from pictures of a checkerboard.
void add_calibrate_camera_command(CLI::App& app);

}  // namespace docent::apps::calibrate_camera_command
