#include "docent/simulator/sensing/scanner_kind.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace docent::simulator {

LaserParams laser_of(const ScannerKind& kind) {
  constexpr double kMostNoise = 0.05;  // [m]
  LaserParams params;
  if (kind.beams > 0) {
    params.beams = kind.beams;
    params.bearing_step = kind.field / kind.beams;
  } else {
    params.beams = std::max(1, static_cast<int>(std::lround(kind.field / params.bearing_step)));
  }
  params.first_bearing = -0.5 * params.beams * params.bearing_step;
  const double more = kind.max_range / params.max_range;
  params.noise_far = std::min(params.noise_near + (params.noise_far - params.noise_near) * more, kMostNoise);
  params.max_range = kind.max_range;
  return params;
}

WrittenSweep as_written(const ScannerKind& kind, const LaserParams& params, std::span<const float> ranges) {
  const double mirrored = kind.is_upside_down ? -1.0 : 1.0;
  const bool is_reversed = kind.is_clockwise != kind.is_upside_down;
  const double last = params.first_bearing + (params.beams - 1) * params.bearing_step;
  WrittenSweep written{mirrored * (is_reversed ? last : params.first_bearing),
                       kind.is_clockwise ? -params.bearing_step : params.bearing_step,
                       {ranges.begin(), ranges.end()}};
  if (is_reversed) std::reverse(written.ranges.begin(), written.ranges.end());
  if (kind.no_return == NoReturn::greatest) return written;
  const float nothing = kind.no_return == NoReturn::zero ? 0.0F : std::numeric_limits<float>::infinity();
  for (float& range : written.ranges)
    if (static_cast<double>(range) >= params.max_range) range = nothing;
  return written;
}

bool is_due(std::size_t step, double rate) {
  const auto sweeps = [rate](std::size_t steps) {
    return std::floor(static_cast<double>(steps) * rate / 100.0 + 1e-9);
  };
  return step == 0 || sweeps(step) > sweeps(step - 1);
}

}  // namespace docent::simulator
