#include "docent/simulator/crowd/steering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace docent::simulator {
namespace {

constexpr double kHorizon = 2.5;  // [s] people look so far ahead

/// How two discs approach each other that keep their velocities.
struct Approach {
  Approach(Point2 offset, Point2 relative_velocity, double squared_gap)
      : gap{squared_gap},
        closing{dot(offset, relative_velocity)},
        discriminant{closing * closing - dot(relative_velocity, relative_velocity) * gap} {}
  Approach() = default;

  /// False when they do not touch within the horizon [s] for sure: the root is at most `closing`. No branch.
  [[nodiscard]] bool may_touch(double horizon) const {
    constexpr double kRounding = 1.0 + 1e-9;
    return static_cast<bool>(static_cast<int>(closing > 0.0) & static_cast<int>(discriminant >= 0.0) &
                             static_cast<int>(gap <= 2.0 * kRounding * horizon * closing));
  }
  /// [s], 0 when they overlap. @pre may_touch
  [[nodiscard]] double time() const { return gap <= 0.0 ? 0.0 : gap / (closing + std::sqrt(discriminant)); }

  double gap;      ///< [m2] square of the distance less that of the reach
  double closing;  ///< [m2/s]
  double discriminant;
};

/// [m2] square of the distance less that of the reach
double gap_of(const Neighbour& neighbour) {
  return dot(neighbour.offset, neighbour.offset) - neighbour.reach * neighbour.reach;
}

/// What a person weighs velocities by.
class Scales {
 public:
  Scales(const Person& person, Point2 desired, std::span<const Neighbour> neighbours, const WalkableFloor& floor,
         double waited)
      : person_{person},
        desired_{desired},
        speed_{norm(desired)},
        haste_{0.6 + 0.3 * std::min(waited, 4.0)},
        neighbours_{neighbours},
        floor_{floor},
        need_{std::min(person.radius, 0.26)},
        room_{floor.clearance(person.position) - need_} {
    std::transform(neighbours.begin(), neighbours.end(), gaps_.begin(), gap_of);
  }

  /// What a velocity costs; some cost of at least `bound` as soon as it is known to be no less.
  [[nodiscard]] double cost_of(Point2 velocity, double bound) const {
    const double speed = norm(velocity);
    double cost = 0.0;
    if (speed_ < 0.05) {
      cost = 0.15 * norm(velocity - person_.velocity) + speed;
    } else {
      // A step aside costs less than waiting: else two who meet head on would stand for ever. One who has waited
      // for some seconds goes back a little, too, to get round what they stand against.
      const double forward = dot(velocity, desired_) / speed_;
      const double sideways = std::abs(cross(velocity, desired_)) / speed_;
      const double off = (speed_ - forward) + 0.35 * sideways;
      if (off >= bound) return off;
      cost = 0.15 * norm(velocity - person_.velocity) + (off + haste_ * std::max(0.0, 0.4 * speed_ - speed));
    }
    if (cost < bound) cost = with_neighbours(cost, velocity, bound);
    return cost < bound ? with_walls(cost, velocity, speed) : cost;
  }

 private:
  [[nodiscard]] double with_neighbours(double cost, Point2 velocity, double bound) const {
    // First, and without a branch, who may be touched at all.
    std::array<Approach, kMostNeighbours> approaches;
    std::array<std::uint8_t, kMostNeighbours> whose{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < neighbours_.size(); ++i) {
      approaches[count] = {neighbours_[i].offset, velocity - neighbours_[i].velocity, gaps_[i]};
      whose[count] = static_cast<std::uint8_t>(i);
      count += static_cast<std::size_t>(approaches[count].may_touch(kHorizon));
    }
    for (std::size_t i = 0; i < count && cost < bound; ++i) {
      const double time = approaches[i].time();
      if (time > kHorizon) continue;
      const Neighbour& neighbour = neighbours_[whose[i]];
      if (time > 0.0) {
        cost += neighbour.weight * 0.6 * (1.0 / (time + 0.2) - 1.0 / (kHorizon + 0.2));
      } else {
        // Too near already: what counts is how fast the gap closes.
        const double away = std::max(norm(neighbour.offset), 1e-3);
        const double closing = approaches[i].closing / away;
        cost += neighbour.weight * (1.0 + 3.0 * std::max(0.0, closing + 0.2));
      }
    }
    return cost;
  }

  [[nodiscard]] double with_walls(double cost, Point2 velocity, double speed) const {
    if (dot(velocity, velocity) <= 1e-6) return cost;
    // The clearance falls by less than 1.5 m a metre: where there is room enough here, walls need not be looked for.
    if (room_ < 1.5 * 0.3 * speed && clearance_after(0.3, velocity) < 0.0) cost += 4.0;
    if (room_ > 0.15 + 1.5 * 0.8 * speed) return cost;
    const double far = clearance_after(0.8, velocity);
    if (far < 0.0) cost += 1.0;
    if (far < 0.15) cost += 0.3 * (0.15 - far) / 0.15;
    return cost;
  }
  [[nodiscard]] double clearance_after(double time, Point2 velocity) const {
    return floor_.clearance(person_.position + time * velocity) - need_;
  }

  const Person& person_;
  Point2 desired_;
  double speed_;  ///< [m/s] desired
  double haste_;  ///< what it costs to be slower than one might
  std::span<const Neighbour> neighbours_;
  const WalkableFloor& floor_;
  double need_;  ///< [m] clearance
  double room_;  ///< [m] how much more there is here
  std::array<double, kMostNeighbours> gaps_;
};

}  // namespace

std::optional<double> time_to_touch(Point2 offset, Point2 relative_velocity, double reach) {
  const Approach approach{offset, relative_velocity, dot(offset, offset) - reach * reach};
  return approach.may_touch(std::numeric_limits<double>::infinity()) ? std::optional{approach.time()} : std::nullopt;
}

Point2 choose_velocity(const Person& person, Point2 desired, std::span<const Neighbour> neighbours,
                       const WalkableFloor& floor, double waited) {
  const double wanted_speed = norm(desired);
  if (wanted_speed < 0.05) {
    // A person who stands moves only when something comes at them.
    const bool is_threatened = std::any_of(neighbours.begin(), neighbours.end(), [](const Neighbour& neighbour) {
      const auto time = time_to_touch(neighbour.offset, Point2{} - neighbour.velocity, neighbour.reach);
      return time && *time < 2.0;
    });
    if (!is_threatened) return {};
  }
  const Scales scales{person, desired, neighbours, floor, waited};
  Point2 best = desired;
  double best_cost = scales.cost_of(desired, std::numeric_limits<double>::infinity());
  const auto consider = [&](Point2 velocity) {
    const double cost = scales.cost_of(velocity, best_cost);
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
