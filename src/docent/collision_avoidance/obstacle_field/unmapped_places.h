#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/obstacle_field/near_points.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct UnmappedPlacesParams {
  double by_somebody = 0.4;       ///< [m] from a beam that the map does not explain to the rest of who ended it
  double judged_together = 0.15;  ///< [s] in which the beams of all lasers come
  double still_judged = 0.6;      ///< [s] until what came into view since counts for more
};

/// Where beams ended that the map does not explain, as localization says: there may be somebody. Kept in the
/// odometry's frame.
class UnmappedPlaces {
 public:
  explicit UnmappedPlaces(const UnmappedPlacesParams& params = {}) : params_{params} {}

  /// Each laser may be judged by itself: what another one met a moment ago stays.
  /// @param taken  local time of the beams @param odom_from_base  at that time
  /// @param localized  whether the robot has a place in the map; without one, nothing is explained
  void add(Time now, Time taken, const Pose2& odom_from_base, std::span<const Point2> in_base, bool localized);

  /// Whether what was said last tells of what stands around at `when`.
  [[nodiscard]] bool judge(Time when) const;
  /// @pre judge
  [[nodiscard]] bool is_near(Point2 in_odom) const { return near_->is_near(in_odom); }

 private:
  struct Beam {
    Point2 in_odom;
    Time heard;
  };
  UnmappedPlacesParams params_;
  std::vector<Beam> beams_;
  std::optional<NearPoints> near_;  ///< of these
  Time taken_{};                    ///< when the newest were
  bool localized_ = false;
};

}  // namespace docent::collision_avoidance
