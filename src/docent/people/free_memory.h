#pragma once

#include <cstdint>
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

  /// O(beams * cells a beam).
  void add(const sensor_models::RangeSweep& sweep, const Pose2& odom_from_base, Time time);
  /// True when all that surrounds the point was seen free before something came to be seen there.
  [[nodiscard]] bool has_come(Point2 in_odom) const;

 private:
  enum class Kind : std::uint8_t { unknown, free, come, standing };
  struct Cell {
    std::int32_t column = 0, row = 0;  ///< which of the cells that share this place
    std::int32_t time = -1000000;      ///< [0.1 s] last seen
    std::int32_t end = -1000000;       ///< [0.1 s] last time that a beam ended here
    Kind kind = Kind::unknown;
  };
  [[nodiscard]] const Cell* find(std::int32_t column, std::int32_t row) const;
  Cell& touch(std::int32_t column, std::int32_t row);

  std::vector<Cell> cells_;      ///< [kSide * kSide], wrapping round
  std::int32_t now_ = -1000000;  ///< [0.1 s]
};

}  // namespace docent::people
