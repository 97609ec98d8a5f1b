#pragma once

#include <cstdint>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/sensing/camera/optics/raw_picture.h"

namespace docent::simulator {

/// A depth camera that throws a pattern of points and sees them from the side, as the first Kinect did. Its noise grows
/// with the square of the distance, and so do its steps.
struct DepthSensor {
  double nearest = 0.45;          ///< [m]
  double farthest = 6.0;          ///< [m]
  double baseline = 0.075;        ///< [m] of the projector, to the right of the camera
  double disparity_step = 0.125;  ///< [pixels] that it can tell apart
  double noise = 0.0012;          ///< [m] deviation at 0.4 m
  double noise_growth = 0.0019;   ///< [1/m] deviation more, by the square of what is beyond 0.4 m
  double least_slant = 0.18;      ///< cosine: surfaces more slanted give nothing
  double lost_on_glass = 0.8;     ///< share of pixels behind a pane that give nothing; others are too long
  double glass_delay = 0.02;      ///< [m] so much too long
  double lost = 0.002;            ///< share of pixels anywhere that give nothing
  double lost_when_dark = 0.15;   ///< of surfaces that throw back less than a twentieth of the light
};

/// Depths along the optical axis [mm], 0: none. [height][width]. @param focal  [pixels] of the lens
[[nodiscard]] std::vector<std::uint16_t> measure(const RawDepth& raw, const DepthSensor& sensor, double focal,
                                                 Rng& rng);

}  // namespace docent::simulator
