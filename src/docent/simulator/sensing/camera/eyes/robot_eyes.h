#pragma once

#include <cstdint>
#include <vector>

#include "docent/base/random.h"
#include "docent/pictures/image.h"
#include "docent/simulator/sensing/camera/eyes/eye_rig.h"
#include "docent/simulator/sensing/camera/optics/depth_sensor.h"
#include "docent/simulator/sensing/camera/optics/picture_sensor.h"
#include "docent/simulator/sensing/camera/optics/shake.h"
#include "docent/simulator/sensing/camera/renderer.h"

namespace docent::simulator {

struct RobotEyesParams {
  RigOptions rig;
  std::uint64_t seed = 1;  ///< of errors of lenses and mounts, and of how it rocks
  double lean = 0.3;       ///< [degrees] the base rocks so far about each axis
  double exposure = 0.01;  ///< [s] a picture is exposed
  PictureSensor up{.gain = 0.75, .vignetting = 0.3};
  PictureSensor front{.gain = 0.9, .vignetting = 0.25, .colour_cast = 0.04};
  DepthSensor depth;
};

/// A robot at the middle of an exposure.
struct Glimpse {
  double time = 0.0;  ///< [s]
  Pose2 world_from_base;
  double linear = 0.0;   ///< [m/s]
  double angular = 0.0;  ///< [rad/s]
  double gain = 1.0;     ///< of the exposure, beside the sensor's own
  Lighting lighting{};
};

/// What the robot's cameras see of what a renderer has. They draw from the chance that they are handed, nothing else.
class RobotEyes {
 public:
  explicit RobotEyes(const RobotEyesParams& params);

  /// The rig as a robot would be told, and as it is.
  [[nodiscard]] const EyeRig& told() const { return told_; }
  [[nodiscard]] const EyeRig& truth() const { return true_; }
  [[nodiscard]] Lean lean_at(double time) const { return shake_.at(time); }

  /// Grey, [height][width]. O(pixels log(triangles)), more where the picture moves.
  [[nodiscard]] std::vector<std::uint8_t> look_up(const Renderer& renderer, const Glimpse& glimpse, Rng& rng) const;
  [[nodiscard]] pictures::Image look_ahead(const Renderer& renderer, const Glimpse& glimpse, Rng& rng) const;
  /// [mm], 0 none. [height][width]
  [[nodiscard]] std::vector<std::uint16_t> measure_depths(const Renderer& renderer, const Glimpse& glimpse,
                                                          Rng& rng) const;

 private:
  [[nodiscard]] RawPicture exposed(const Renderer& renderer, const Eye& eye, const RayTable& lens,
                                   const Glimpse& glimpse) const;

  RobotEyesParams params_;
  EyeRig told_, true_;
  RayTable up_, front_, depth_;
  Shake shake_;
};

}  // namespace docent::simulator
