#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "docent/base/random.h"
#include "docent/pictures/image.h"
#include "docent/simulator/sensing/camera/optics/raw_picture.h"

namespace docent::simulator {

/// What a sensor makes of light.
struct PictureSensor {
  double gain = 1.0;          ///< of the exposure: 2 is one stop brighter
  double vignetting = 0.25;   ///< share of the light that is lost 45 degrees off the axis, growing with its square
  double read_noise = 0.004;  ///< deviation, share of full scale
  double shot_noise = 0.012;  ///< deviation at full scale; grows with the root of the light
  double gamma = 2.2;         ///< of the numbers; 1: linear
  double colour_cast = 0.0;   ///< red is so much stronger, blue so much weaker
};

/// Grey, as cameras for machines see. [height][width], 0..255. O(pixels).
[[nodiscard]] std::vector<std::uint8_t> develop_grey(const RawPicture& raw, const PictureSensor& sensor, Rng& rng);
/// In colour.
[[nodiscard]] pictures::Image develop(const RawPicture& raw, const PictureSensor& sensor, Rng& rng);

/// The exposure of a camera that corrects itself by steps now and then: the same for some pictures, then another.
/// @param steps_per_picture  chance of a step; @param range  [stops] up and down
[[nodiscard]] std::vector<double> stepped_gains(std::size_t pictures, double steps_per_picture, double range, Rng rng);

}  // namespace docent::simulator
