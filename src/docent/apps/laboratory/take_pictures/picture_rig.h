#pragma once

#include <string>

#include "docent/base/random.h"
#include "docent/simulator/sensing/camera/optics/lens_model.h"
#include "docent/simulator/sensing/camera/optics/viewpoint.h"

namespace docent::apps::take_pictures_command {

/// A camera on the robot.
struct Eye {
  simulator::LensModel lens;
  simulator::CameraMount mount;
};

/// Three of them: one that looks at the ceiling, one ahead and down, and a depth camera beside it.
struct PictureRig {
  Eye up, front, depth;
};

struct RigOptions {
  int width = 320;       ///< [pixels] of all pictures
  int height = 240;      ///< [pixels]
  bool fisheye = false;  ///< the upward one is; otherwise a pinhole with distortion
};

/// As the drawings of the robot have it and a calibration found it.
[[nodiscard]] PictureRig told_rig(const RigOptions& options);
/// As it is: lenses and mounts are a little different, by chance.
[[nodiscard]] PictureRig true_rig(const PictureRig& told, Rng rng);
/// All constants. Angles in degrees.
[[nodiscard]] std::string to_yaml(const PictureRig& rig);

}  // namespace docent::apps::take_pictures_command
