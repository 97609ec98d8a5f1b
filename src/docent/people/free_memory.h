#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::people {

/// What the last minute of sweeps saw free round the robot, in odometry's frame: something that stands where the floor
/// was free has come there by itself. It needs no map and no place in one.
class FreeMemory {
 public:
  FreeMemory();

  /// What the map holds has not come, whatever its rims look like. O(beams * cells a beam).
  /// @param origins  [beams]
  void add(const sensor_models::RangeSweep& sweep, std::span<const sensor_models::BeamOrigin> origins,
           const Pose2& odom_from_base, Time time);
  /// True when all that surrounds the point was seen free before something came to be seen there.
  [[nodiscard]] bool has_come(Point2 in_odom) const;
  /// What stands there was seen to be a thing by its shape: remembered until beams pass. No effect where it has come.
  void mark_thing(Point2 in_odom);
  /// Whether a thing stands here, or in the next cell: what half hides it may leave a piece as narrow as a person.
  [[nodiscard]] bool is_thing(Point2 in_odom) const;

 private:
  enum class Kind : std::uint8_t { unknown, free, come, standing, thing };
  struct Cell {
    std::int32_t column = 0, row = 0;  ///< which of the cells that share this place
    std::int32_t time = -1000000;      ///< [0.1 s] last seen
    std::int32_t end = -1000000;       ///< [0.1 s] last time that a beam ended here
    Kind kind = Kind::unknown;
  };
  /// Has been there since before it was first seen.
  [[nodiscard]] static bool has_stood(const Cell* cell) {
    return cell != nullptr && (cell->kind == Kind::standing || cell->kind == Kind::thing);
  }
  [[nodiscard]] const Cell* find(std::int32_t column, std::int32_t row) const;
  Cell& touch(std::int32_t column, std::int32_t row);

  std::vector<Cell> cells_;      ///< [kSide * kSide], wrapping round
  std::int32_t now_ = -1000000;  ///< [0.1 s]
};

}  // namespace docent::people
