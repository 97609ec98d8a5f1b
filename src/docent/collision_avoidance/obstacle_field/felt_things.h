#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

struct FeltThingsParams {
  double radius = 0.3;        ///< [m] of the disc that a touch is believed to be of: stools, baskets, boxes
  double least = 0.02;        ///< [m] a smaller disc is a point
  double same = 0.1;          ///< [m] between the middles of two discs that are of one thing
  double forget = 1800.0;     ///< [s] after the last touch, then the place is tried again
  double forget_doubt = 300;  ///< [s] likewise where it may have been somebody
  std::size_t most = 200;     ///< discs; then the oldest is forgotten
};

/// What only touch finds stays felt: where the body met something that no laser sees there stands a disc, until the
/// body itself has stood in its place. That a laser sees nothing there proves nothing, for it looks above it. In a
/// frame of the building, the map's or, as long as the robot does not know its place, odometry's.
///
/// A disc that touches the body at `at` has its middle on the line from the body's centre through that place; so a
/// round thing of at most that radius lies in it, wherever it was met. Deterministic. O(discs) each.
class FeltThings {
 public:
  struct Disc {
    Point2 at;            ///< [m] the touched place
    Point2 outward;       ///< unit vector, from the body's centre
    double radius = 0.0;  ///< [m]
    Time until;
    [[nodiscard]] Point2 middle() const { return at + radius * outward; }
  };

  explicit FeltThings(const FeltThingsParams& params = {}) : params_{params} {}

  /// @param may_be_somebody  who may have gone since
  void feel(Point2 at, Point2 outward, bool may_be_somebody, Time now);
  /// The body stands here, as a disc: no part of a thing is within `radius` [m], so discs shrink, and what was touched
  /// within it is gone.
  void stand(Point2 centre, double radius);
  void forget(Time now);
  /// The frame is another one: `new_from_old` takes places over.
  void carry(const Pose2& new_from_old);

  [[nodiscard]] std::span<const Disc> discs() const { return discs_; }

 private:
  FeltThingsParams params_;
  std::vector<Disc> discs_;
};

}  // namespace docent::collision_avoidance
