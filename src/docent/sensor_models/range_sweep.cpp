#include "docent/sensor_models/range_sweep.h"

#include <cmath>
#include <limits>

#include <numbers>
#include "docent/geometry/point_transform.h"

namespace docent::sensor_models {

void append(RangeSweep& sweep, const LaserReading& reading, const Pose2& base_from_sensor) {
  const PointTransform of_points{base_from_sensor};
  sweep.beams.reserve(sweep.beams.size() + reading.ranges.size());
  for (std::size_t i = 0; i < reading.ranges.size(); ++i) {
    const double range = reading.ranges[i];
    if (std::isnan(range) || range < reading.min_range) continue;
    const Angle bearing =
        Angle::radians(reading.first_bearing.radians() + static_cast<double>(i) * reading.bearing_step);
    if (range >= reading.max_range) {
      sweep.beams.push_back({(base_from_sensor.theta + bearing).radians(), reading.max_range, true});
      continue;
    }
    const Point2 end = of_points * (range * unit(bearing));
    sweep.beams.push_back({std::atan2(end.y, end.x), norm(end), false});
  }
}

RangeSweep seen_from(const RangeSweep& sweep, const Pose2& there_from_here) {
  RangeSweep result;
  result.beams.reserve(sweep.beams.size());
  const PointTransform of_points{there_from_here};
  for (const SweepBeam& beam : sweep.beams) {
    if (beam.no_return) {
      const Angle bearing = Angle::radians(beam.bearing) + there_from_here.theta;
      result.beams.push_back({bearing.radians(), beam.range, true});
      continue;
    }
    const Point2 end = of_points * endpoint(beam);
    result.beams.push_back({std::atan2(end.y, end.x), norm(end), false});
  }
  return result;
}

RangeSweep within_reach(RangeSweep sweep, double reach) {
  for (SweepBeam& beam : sweep.beams)
    if (beam.range >= reach) beam = {beam.bearing, reach, true};
  return sweep;
}

Point2 endpoint(const SweepBeam& beam) {
  return {beam.range * std::cos(beam.bearing), beam.range * std::sin(beam.bearing)};
}

std::vector<BinnedBeam> binned(const RangeSweep& sweep, int directions) {
  const double step = 2.0 * std::numbers::pi / directions;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  std::vector<double> off_middle(static_cast<std::size_t>(directions), kNone);
  std::vector<std::size_t> nearest(static_cast<std::size_t>(directions), 0);
  for (std::size_t i = 0; i < sweep.beams.size(); ++i) {
    const double position = sweep.beams[i].bearing / step;
    const double rounded = std::floor(position + 0.5);
    int direction = static_cast<int>(rounded) % directions;
    if (direction < 0) direction += directions;
    const auto slot = static_cast<std::size_t>(direction);
    const double off = std::abs(position - rounded);
    if (off < off_middle[slot]) {
      off_middle[slot] = off;
      nearest[slot] = i;
    }
  }
  std::vector<BinnedBeam> result;
  result.reserve(static_cast<std::size_t>(directions));
  for (std::size_t slot = 0; slot < off_middle.size(); ++slot)
    if (off_middle[slot] < kNone)
      result.push_back({static_cast<std::uint16_t>(slot), static_cast<std::uint16_t>(nearest[slot])});
  return result;
}

std::vector<BinnedBeam> thinned(std::span<const BinnedBeam> beams, std::size_t most, std::size_t phase) {
  if (beams.size() <= most) return {beams.begin(), beams.end()};
  std::vector<BinnedBeam> chosen;
  const std::size_t start = phase * 7 % beams.size();
  for (std::size_t i = 0; i < most; ++i) chosen.push_back(beams[(start + i * beams.size() / most) % beams.size()]);
  return chosen;
}

}  // namespace docent::sensor_models
