#include "docent/localization/beam_choice/moved_things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "docent/localization/beam_choice/person_shapes.h"

namespace docent::localization {
namespace {

constexpr int kBearingsLooked = 360;    // of a turn
constexpr double kNearestMoved = 0.4;   // [m]: nearer is the robot itself, or whoever touches it
constexpr double kFarthestMoved = 8.0;  // [m]: farther off a beam is wider than a person is to be told
constexpr double kLookedThrough =
    0.4;                            // [m] and more a beam must have passed on: odometry errs, and walls are seen askew
constexpr int kBearingsBeside = 2;  // bearings to both sides that must have looked through as well

/// [bearings] how far the sweep has looked at least; 0: nowhere.
std::array<double, kBearingsLooked> looked_through(const sensor_models::RangeSweep& sweep) {
  std::array<double, kBearingsLooked> far{};
  for (const sensor_models::SweepBeam& beam : sweep.beams) {
    const double at = (beam.bearing / (2.0 * std::numbers::pi) + 1.0) * kBearingsLooked;
    double& range = far[static_cast<std::size_t>(std::floor(at + 0.5)) % kBearingsLooked];
    range = range > 0.0 ? std::min(range, beam.range) : beam.range;
  }
  // Scanners with fewer beams than bearings look between them, too.
  const std::array<double, kBearingsLooked> seen = far;
  for (std::size_t i = 0; i < kBearingsLooked; ++i) {
    if (seen[i] > 0.0) continue;
    double nearest = 0.0;
    for (std::size_t off = 1; off <= 4 && nearest == 0.0; ++off) {
      const double left = seen[(i + off) % kBearingsLooked],
                   right = seen[(i + kBearingsLooked - off) % kBearingsLooked];
      nearest = left > 0.0 && right > 0.0 ? std::min(left, right) : std::max(left, right);
    }
    far[i] = nearest;
  }
  return far;
}

/// What of `now` stands where `before` has looked through, and is shaped like a person: doors, errors of odometry and
/// walls that are seen askew are not.
MovedThings come_since(const std::array<double, kBearingsLooked>& before, const sensor_models::RangeSweep& now,
                       const Pose2& before_from_now) {
  MovedThings result;
  const std::vector<std::uint8_t> is_person = on_person_shapes(now);
  for (std::size_t i = 0; i < now.beams.size(); ++i) {
    const sensor_models::SweepBeam& beam = now.beams[i];
    if (beam.no_return || beam.range < kNearestMoved || beam.range > kFarthestMoved) continue;
    const Point2 end = before_from_now * sensor_models::endpoint(beam);
    const double at = (std::atan2(end.y, end.x) / (2.0 * std::numbers::pi) + 1.0) * kBearingsLooked;
    const auto middle = static_cast<std::size_t>(std::floor(at + 0.5)) + kBearingsLooked;
    double least = before[middle % kBearingsLooked];
    for (std::size_t off = 1; off <= kBearingsBeside; ++off)
      least = std::min({least, before[(middle + off) % kBearingsLooked], before[(middle - off) % kBearingsLooked]});
    if (least <= 0.0) continue;
    ++result.readings;
    result.moved += is_person[i] != 0 && least > norm(end) + kLookedThrough ? 1 : 0;
  }
  return result;
}

}  // namespace

MovedThings& MovedThings::operator+=(const MovedThings& other) {
  readings += other.readings;
  moved += other.moved;
  return *this;
}

double MovedThings::share() const {
  return readings > 0 ? static_cast<double>(moved) / static_cast<double>(readings) : 0.0;
}

MovedThings moved_things(const sensor_models::RangeSweep& before, const sensor_models::RangeSweep& now,
                         const Pose2& before_from_now) {
  MovedThings result = come_since(looked_through(before), now, before_from_now);
  return result += come_since(looked_through(now), before, inverse(before_from_now));
}

}  // namespace docent::localization
