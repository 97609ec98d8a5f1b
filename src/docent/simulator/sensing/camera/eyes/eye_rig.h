#pragma once

#include <optional>
#include <string>

#include "docent/base/random.h"
#include "docent/simulator/sensing/camera/optics/lens_model.h"
#include "docent/simulator/sensing/camera/optics/viewpoint.h"

namespace docent::simulator {

/// A camera on the robot.
struct Eye {
  LensModel lens;
  CameraMount mount;
};

/// Three of them: one that looks at the ceiling, one ahead and down, and a depth camera beside it.
struct EyeRig {
  Eye up, front, depth;
};

struct RigOptions {
  std::optional<CameraMount> up_mount{}, depth_mount{},
      front_mount{};     ///< as the robot is told; without: as it was drawn first
  int width = 320;       ///< [pixels] of all pictures
  int height = 240;      ///< [pixels]
  bool fisheye = false;  ///< the upward one is; otherwise a pinhole with distortion
};

/// As the drawings of the robot have it and a calibration found it.
[[nodiscard]] EyeRig told_rig(const RigOptions& options);
/// As it is: lenses and mounts are a little different, by chance.
[[nodiscard]] EyeRig true_rig(const EyeRig& told, Rng rng);
/// All constants. Angles in degrees.
[[nodiscard]] std::string to_yaml(const EyeRig& rig);

}  // namespace docent::simulator
