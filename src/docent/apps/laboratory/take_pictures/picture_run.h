#pragma once

#include <filesystem>
#include <functional>

#include "docent/apps/laboratory/take_pictures/picture_drive.h"
#include "docent/simulator/sensing/camera/eyes/robot_eyes.h"

namespace docent::apps::take_pictures_command {

struct PictureRunOptions {
  simulator::RobotEyesParams eyes;
  bool up = true;  ///< these pictures are taken
  bool front = true;
  bool depth = true;
  std::uint64_t seed = 1;        ///< of noise, gains and what is told of poses; the eyes have their own
  double exposure_steps = 0.02;  ///< chance of another exposure, a picture
  double exposure_range = 0.7;   ///< [stops] up and down
  simulator::Lighting lighting;
};

/// Draws what the cameras see on a drive through an empty museum, into a folder: `up`, `front` and `depth` with
/// pictures NNNNNN.png (grey of 8 bits, colours, grey of 16 bits in mm), `poses.csv` and `cameras.yaml` as the robot
/// would be told them, and in `truth` the same as they are, with how the base leaned, gains, and the ceiling's heights
/// on a grid.
/// @param taken  called after each picture with how many there are
[[nodiscard]] Result<void> take_pictures(const simulator::World& world, const Drive& drive,
                                         const PictureRunOptions& options, const std::filesystem::path& folder,
                                         const std::function<void(std::size_t)>& taken);

}  // namespace docent::apps::take_pictures_command
