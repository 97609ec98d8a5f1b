#pragma once

#include <optional>
#include <span>

#include "docent/simulator/crowd/person.h"
#include "docent/simulator/crowd/walkable_floor.h"

namespace docent::simulator {

/// Someone or something round that moves and shall not be touched.
struct Neighbour {
  Point2 offset;        ///< [m] from the person's centre to its centre
  Point2 velocity;      ///< [m/s]
  double reach = 0.5;   ///< [m] sum of both radii and the space kept
  double weight = 1.0;  ///< how much it is respected
};

/// Time until two discs touch that keep their velocities [s]; nullopt: never; 0 when they overlap and approach.
[[nodiscard]] std::optional<double> time_to_touch(Point2 offset, Point2 relative_velocity, double reach);

inline constexpr std::size_t kMostNeighbours = 14;

/// The velocity that a person takes to move as desired and yet touch nobody: the best of a small fan of velocities
/// round the desired one, each judged by its time to touch (as people do) and by the room to walls.
/// @param waited  [s] since they last got on: patience ends
/// O(candidates * neighbours), deterministic. @pre at most kMostNeighbours
[[nodiscard]] Point2 choose_velocity(const Person& person, Point2 desired, std::span<const Neighbour> neighbours,
                                     const WalkableFloor& floor, double waited);

}  // namespace docent::simulator
