#pragma once

#include <span>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/sensing/laser.h"
#include "docent/simulator/sensing/ray_caster.h"

namespace docent::simulator {

/// The true ring of infrared sensors, which measure by triangulation. The robot knows none of this but what a data
/// sheet says: count, place, nominal cone, limits.
struct InfraredParams {
  int count = 24;               ///< evenly round the body, the first at the front, counter-clockwise
  double ring_radius = 0.25;    ///< [m] from the body's centre
  double field_of_view = 0.09;  ///< [rad] nominal cone
  double min_range = 0.06;      ///< [m]
  double max_range = 0.8;       ///< [m]; nothing in reach reads so
  double quantum = 0.01;        ///< [m]
  double noise_near = 0.004;    ///< [m] standard deviation of a near reading,
  double noise_far = 0.05;      ///< [m] and at max_range; it grows with the square of the distance
  double slope_error = 0.04;    ///< largest relative error of one sensor's calibration
  double grazing = 0.2;         ///< cosine of the angle of incidence below which a smooth surface mirrors it all away
  double dark_clothes = 0.3;    ///< chance that what somebody wears is dark where it is met
  double dark_reach = 0.45;     ///< of max_range: dark clothes send nothing back from beyond
  double glare = 0.004;         ///< chance that a lamp or the sun blinds it: nothing in reach
  double flicker = 0.001;       ///< chance of a reading that comes too short
};

/// Light is traced as rays. What is nearer than the least distance folds over and reads too far; dark clothes and
/// slanted smooth surfaces send back nothing, glass hardly anything. All randomness from a stream of its own.
class InfraredRing {
 public:
  InfraredRing(const InfraredParams& params, Rng rng);

  /// What sensor `index` reads [m], from its place on the ring. O(rays * (cells + people)).
  [[nodiscard]] double read(int index, const RayCaster& walls, std::span<const Disc> people,
                            const Pose2& world_from_base);
  [[nodiscard]] const InfraredParams& params() const { return params_; }

 private:
  [[nodiscard]] double true_range(Point2 origin, Angle axis, const RayCaster& walls, std::span<const Disc> people);

  InfraredParams params_;
  Rng rng_;
  std::vector<double> slopes_;  ///< measured over true distance, each sensor's own
};

}  // namespace docent::simulator
