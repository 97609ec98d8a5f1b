#pragma once

#include <filesystem>
#include <functional>

#include "docent/apps/laboratory/take_pictures/picture_drive.h"
#include "docent/apps/laboratory/take_pictures/picture_rig.h"
#include "docent/simulator/sensing/camera/ceiling/ceiling.h"

namespace docent::apps::take_pictures_command {

struct PictureRunOptions {
  RigOptions rig;
  bool up = true;  ///< these pictures are taken
  bool front = true;
  bool depth = true;
  std::uint64_t seed = 1;        ///< of lens errors, noise, rocking, exposure and what is told of poses
  double lean = 0.3;             ///< [degrees] the base rocks so far about each axis
  double exposure = 0.01;        ///< [s] a picture is exposed
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
