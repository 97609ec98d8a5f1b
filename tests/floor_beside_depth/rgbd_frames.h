#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "docent/pictures/image.h"
#include "docent/vision/depth/ground_plane.h"
#include "docent/vision/scene/floor_mask.h"

namespace docent::floor_beside_depth {

/// Where a Kinect's colour camera looks from, seen from its depth camera. The recorded pictures are not registered;
/// these were found once by laying the depth's edges on the colours' (mean gradient under 25,000 edges 3.2 without, 4.7
/// with them), and hold for all frames.
struct ColourCamera {
  double focal = 526.4;     ///< [pixels]
  double centre_x = 322.6;  ///< [pixels]
  double centre_y = 236.6;  ///< [pixels]
  double right = -0.0315;   ///< [m] that what it sees lies farther to its right, and
  double down = 0.0049;     ///< [m] lower
};

/// A frame of `$DOCENT_DATA/vision/rgbd`.
struct Frame {
  std::string name;
  pictures::Image colour{1, 1};
  vision::DepthPicture depth;
  Eigen::Matrix3d world_from_camera;  ///< of the depth camera
  Eigen::Vector3d position;           ///< [m] world
};

/// All frames, by name; empty: there are none. Fails the test on a damaged one.
[[nodiscard]] std::vector<Frame> frames_of(const std::filesystem::path& folder, double& focal);

/// The floor of all frames together, in their world: what calibrating the mount would say. The plane that most points
/// lie on is level, and of all level ones with more than a hundredth of the points the floor is the lowest.
struct WorldFloor {
  Eigen::Vector3d up;   ///< of length 1
  double height = 0.0;  ///< [m] up · point of its points
};
[[nodiscard]] WorldFloor floor_of(const std::vector<Frame>& frames, double focal);

/// The depth camera over the floor as its mount's calibration has it: base frame below it, x along its axis.
[[nodiscard]] vision::DepthCamera depth_camera_of(const Frame& frame, const WorldFloor& floor, double focal);
/// The colour camera, likewise.
[[nodiscard]] vision::DepthCamera colour_camera_of(const Frame& frame, const WorldFloor& floor);

/// What depth says of each pixel of the colour picture.
struct DepthInColour {
  std::vector<vision::SiteKind> kinds;  ///< [480 * 640]
  std::vector<float> away;              ///< [480 * 640] [m] on the floor from below the colour camera
  bool is_plane_seen = false;           ///< else the calibration's is taken
  double off_degrees = 0.0;             ///< of the plane from the calibration
};
[[nodiscard]] DepthInColour depth_in_colour(const Frame& frame, const WorldFloor& floor, double focal);

}  // namespace docent::floor_beside_depth
