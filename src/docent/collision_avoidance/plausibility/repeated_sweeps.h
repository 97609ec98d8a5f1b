#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct RepeatedSweepsParams {
  double memory = 60.0;      ///< [s] older sweeps are forgotten
  int least_readings = 9;    ///< noisy readings that were all repeated: fewer prove nothing
  int in_a_row = 2;          ///< repeats: a scanner without noise may see the same again by chance
  double least_way = 0.015;  ///< [m] between the two places: at rest a scanner without noise says the same
  double least_turn = 0.02;  ///< [rad] likewise
};

/// Finds sweeps that are, to the bit, one of the last minute's, taken elsewhere: a driver that hands out old ones with
/// new stamps. The newest sweep's own repetition is another watch's (a frozen scanner).
class RepeatedSweeps {
 public:
  explicit RepeatedSweeps(const RepeatedSweepsParams& params = {}) : params_{params} {}

  /// @param answers  of them that met something
  /// @returns [s] how old the sweep is that this one, and the one before it, repeat
  std::optional<double> add(Time stamp, std::span<const float> ranges, int answers, const Pose2& odom_from_base);

 private:
  struct Sweep {
    std::uint64_t hash = 0;
    Time stamp;
    Pose2 odom_from_base;
  };
  RepeatedSweepsParams params_;
  std::deque<Sweep> sweeps_;
  int row_ = 0;
};

}  // namespace docent::collision_avoidance
