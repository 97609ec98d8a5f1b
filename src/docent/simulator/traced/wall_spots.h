#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "docent/base/random.h"
#include "docent/geometry/polygon.h"
#include "docent/simulator/crowd/walkable_floor.h"

namespace docent::simulator {

/// Finds room for things that stand with their back to a wall and close no way: before each of them, and to its sides,
/// the floor is free.
class WallSpots {
 public:
  /// @param outline  counter-clockwise round the floor; both must outlive it
  WallSpots(const Polygon& outline, const WalkableFloor& floor, const Rng& rng);

  /// The outline of a box of width x depth [m] at a spot that was not given away before, at least `apart` [m] from all
  /// that was, and which is accepted; nullopt where there is none. O(spots * box).
  [[nodiscard]] std::optional<Polygon> place(double width, double depth, double apart,
                                             const std::function<bool(const Polygon&)>& accept);

 private:
  [[nodiscard]] bool is_free(const Pose2& world_from_spot, double width, double depth) const;

  const WalkableFloor& floor_;
  std::vector<Pose2> spots_;  ///< world_from_spot: at the wall's foot, x into the room; in a drawn order
  std::vector<Point2> taken_;
};

}  // namespace docent::simulator
