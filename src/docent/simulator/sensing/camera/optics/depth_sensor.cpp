#include "docent/simulator/sensing/camera/optics/depth_sensor.h"

#include <algorithm>
#include <cmath>

namespace docent::simulator {
namespace {

constexpr double kClosest = 0.4;  // [m] from where noise grows
constexpr float kDark = 0.05F;    // share of light

}  // namespace

std::vector<std::uint16_t> measure(const RawDepth& raw, const DepthSensor& sensor, double focal, Rng& rng) {
  std::vector<std::uint16_t> depths(raw.meetings.size(), 0);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const RawDepth::Meeting& met = raw.meetings[i];
    const double lot = rng.uniform(), shake = rng.normal();  // drawn for each, so that pixels do not hang together
    if (met.z <= 0.0F || !met.is_lit || met.slant < sensor.least_slant) continue;
    const bool is_behind_glass = met.glass > 0.0F;
    const double loss = is_behind_glass          ? sensor.lost_on_glass
                        : met.brightness < kDark ? sensor.lost_when_dark
                                                 : sensor.lost;
    if (lot < loss) continue;
    double z = static_cast<double>(met.z) + (is_behind_glass ? sensor.glass_delay : 0.0);
    const double beyond = std::max(0.0, z - kClosest);
    z += shake * (sensor.noise + sensor.noise_growth * beyond * beyond);
    if (z < sensor.nearest || z > sensor.farthest) continue;
    const double steps = std::round(focal * sensor.baseline / z / sensor.disparity_step);
    const double seen = focal * sensor.baseline / (steps * sensor.disparity_step);
    depths[i] = static_cast<std::uint16_t>(std::clamp(std::lround(1000.0 * seen), 1L, 65535L));
  }
  return depths;
}

}  // namespace docent::simulator
