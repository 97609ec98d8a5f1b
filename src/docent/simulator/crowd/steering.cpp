#include "docent/simulator/crowd/steering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace docent::simulator {
namespace {

constexpr double kHorizon = 2.5;  // [s] people look so far ahead

/// A neighbour, and how far it is until both touch.
struct Threat {
  explicit Threat(const Neighbour& neighbour)
      : offset{neighbour.offset},
        velocity{neighbour.velocity},
        gap{dot(offset, offset) - neighbour.reach * neighbour.reach},
        weight{neighbour.weight} {}
  Threat() = default;
  Point2 offset;
  Point2 velocity;
  double gap = 0.0;  ///< [m2] square of the distance less that of the reach
  double weight = 1.0;
};

/// time_to_touch() where it is within the horizon [s].
inline std::optional<double> touch_within(Point2 offset, Point2 relative_velocity, double gap, double horizon) {
  const double closing = dot(offset, relative_velocity);
  if (closing <= 0.0) return std::nullopt;
  if (gap <= 0.0) return 0.0;
  // The root is at most `closing`: for most pairs none is needed.
  constexpr double kRounding = 1.0 + 1e-9;
  if (gap > 2.0 * kRounding * horizon * closing) return std::nullopt;
  const double speed_squared = dot(relative_velocity, relative_velocity);
  const double discriminant = closing * closing - speed_squared * gap;
  if (discriminant < 0.0) return std::nullopt;
  const double time = gap / (closing + std::sqrt(discriminant));
  return time > horizon ? std::nullopt : std::optional{time};
}

/// What a velocity costs; some cost of at least `bound` as soon as it is known to be no less.
double cost_of(Point2 velocity, Point2 desired, const Person& person, std::span<const Threat> threats,
               const WalkableFloor& floor, double waited, double bound) {
  const double speed = norm(desired);
  double cost = 0.15 * norm(velocity - person.velocity);
  if (speed < 0.05) {
    cost += norm(velocity);
  } else {
    // A step aside costs less than waiting: else two who meet head on would stand for ever. Who has waited for some
    // seconds goes back a little, too, to get round what they stand against.
    const double forward = dot(velocity, desired) / speed;
    const double sideways = std::abs(cross(velocity, desired)) / speed;
    cost += (speed - forward) + 0.35 * sideways +
            (0.6 + 0.3 * std::min(waited, 4.0)) * std::max(0.0, 0.4 * speed - norm(velocity));
  }
  for (const Threat& threat : threats) {
    if (cost >= bound) return cost;
    const Point2 relative = velocity - threat.velocity;
    const auto time = touch_within(threat.offset, relative, threat.gap, kHorizon);
    if (!time) continue;
    if (*time > 0.0) {
      cost += threat.weight * 0.6 * (1.0 / (*time + 0.2) - 1.0 / (kHorizon + 0.2));
    } else {
      // Too near already: what counts is how fast the gap closes.
      const double away = std::max(norm(threat.offset), 1e-3);
      const double closing = dot(relative, threat.offset) / away;
      cost += threat.weight * (1.0 + 3.0 * std::max(0.0, closing + 0.2));
    }
  }
  if (cost < bound && dot(velocity, velocity) > 1e-6) {
    const double near = floor.clearance(person.position + 0.3 * velocity) - std::min(person.radius, 0.26);
    const double far = floor.clearance(person.position + 0.8 * velocity) - std::min(person.radius, 0.26);
    if (near < 0.0) cost += 4.0;
    if (far < 0.0) cost += 1.0;
    if (far < 0.15) cost += 0.3 * (0.15 - far) / 0.15;
  }
  return cost;
}

}  // namespace

std::optional<double> time_to_touch(Point2 offset, Point2 relative_velocity, double reach) {
  return touch_within(offset, relative_velocity, dot(offset, offset) - reach * reach,
                      std::numeric_limits<double>::infinity());
}

Point2 choose_velocity(const Person& person, Point2 desired, std::span<const Neighbour> neighbours,
                       const WalkableFloor& floor, double waited) {
  const double wanted_speed = norm(desired);
  if (wanted_speed < 0.05) {
    // Who stands moves only when something comes at them.
    const bool is_threatened = std::any_of(neighbours.begin(), neighbours.end(), [](const Neighbour& neighbour) {
      const auto time = time_to_touch(neighbour.offset, Point2{} - neighbour.velocity, neighbour.reach);
      return time && *time < 2.0;
    });
    if (!is_threatened) return {};
  }
  std::array<Threat, kMostNeighbours> room;
  std::transform(neighbours.begin(), neighbours.end(), room.begin(), [](const Neighbour& n) { return Threat{n}; });
  const auto threats = std::span<const Threat>{room}.first(neighbours.size());
  Point2 best = desired;
  double best_cost = cost_of(desired, desired, person, threats, floor, waited, std::numeric_limits<double>::infinity());
  const auto consider = [&](Point2 velocity) {
    const double cost = cost_of(velocity, desired, person, threats, floor, waited, best_cost);
    if (cost < best_cost - 1e-9) {
      best_cost = cost;
      best = velocity;
    }
  };
  if (best_cost < 0.25 && wanted_speed >= 0.05) return desired;
  consider({});
  if (wanted_speed < 0.05) {
    constexpr std::array<Point2, 8> kDirections{{{1.0, 0.0},
                                                 {0.7071, 0.7071},
                                                 {0.0, 1.0},
                                                 {-0.7071, 0.7071},
                                                 {-1.0, 0.0},
                                                 {-0.7071, -0.7071},
                                                 {0.0, -1.0},
                                                 {0.7071, -0.7071}}};
    for (const Point2 way : kDirections) consider(0.7 * way);
    return best;
  }
  // cosine and sine of +-20, 45, 75, 110 degrees
  constexpr std::array<Point2, 4> kTurns{{{0.9397, 0.3420}, {0.7071, 0.7071}, {0.2588, 0.9659}, {-0.3420, 0.9397}}};
  const double speed = std::max(wanted_speed, 0.4);
  const Point2 ahead = (1.0 / wanted_speed) * desired;
  consider(0.5 * desired);
  for (const auto [c, s] : kTurns) {
    const Point2 left{c * ahead.x - s * ahead.y, s * ahead.x + c * ahead.y};
    const Point2 right{c * ahead.x + s * ahead.y, -s * ahead.x + c * ahead.y};
    for (const double share : {1.0, 0.5}) {
      consider(share * speed * left);
      consider(share * speed * right);
    }
  }
  consider(-0.5 * speed * ahead);
  return best;
}

}  // namespace docent::simulator
