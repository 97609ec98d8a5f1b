#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "docent/base/result.h"
#include "docent/vision/ceiling/ceiling_camera.h"
#include "docent/vision/ceiling/mosaic_drawing.h"

namespace docent::vision {

/// Pictures of a ceiling, each with where the robot believed to be.
struct CeilingDrive {
  CeilingCamera camera;
  std::vector<int> numbers;                      ///< of the pictures, as the files are named
  std::vector<std::vector<std::uint8_t>> bytes;  ///< of each picture, grey
  std::vector<Pose2> map_from_robot;             ///< of each picture
  std::vector<Pose2> odom_from_robot;            ///< of each picture; empty where the drive has no odometry
  /// @pre the drive outlives them
  [[nodiscard]] std::vector<PlacedPicture> placed() const;
};

/// The camera under `up` of a file like `cameras.yaml`: lens (vision/lens/lens_file.h) and `mount` {x, y, z [m], pan,
/// tilt, roll [degrees]}; tilt 90 looks up, the picture's upper edge to the rear. Error: "FILE:LINE: ...".
[[nodiscard]] Result<CeilingCamera> read_up_camera(const std::filesystem::path& path);

/// What `docent-lab take-pictures` writes, or a robot's own recording in this form: `cameras.yaml`, `poses.csv` with
/// the columns picture, map_x, map_y [m] and map_theta [rad], if it has them odometry_x, odometry_y and odometry_theta,
/// and the pictures up/NNNNNN.png, grey or in colour. Nothing else is read. Error: "FILE:LINE: ...".
[[nodiscard]] Result<CeilingDrive> read_ceiling_drive(const std::filesystem::path& folder);

}  // namespace docent::vision
