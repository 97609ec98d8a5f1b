#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/physique/disc.h"
#include "docent/simulator/sensing/ray_caster.h"

namespace docent::simulator {

/// The true scanner. The robot knows none of this.
struct LaserParams {
  int beams = 180;
  double first_bearing = -1.5707963267948966;   ///< [rad]
  double bearing_step = 0.017453292519943295;   ///< [rad]
  double max_range = 10.0;                      ///< [m]; no return reads so
  double noise_near = 0.015;                    ///< [m] standard deviation at 0 m
  double noise_far = 0.030;                     ///< [m] at max_range
  double quantum = 0.01;                        ///< [m]
  double lost = 0.002;                          ///< chance that a beam does not return (black cloth, mirrors)
  double stray = 0.0007;                        ///< chance of a reading that comes too short (dust, cross talk)
  double mixed = 0.25;                          ///< chance of a mixed pixel where neighbouring beams end far apart
  double glass_return = 0.05;                   ///< chance that glass returns at (nearly) perpendicular incidence
  double mount_heading = 0.008726646259971648;  ///< [rad] largest misalignment
  double mount_offset = 0.01;                   ///< [m] largest displacement
};

/// A scanner in a level plane. Noise, quantisation, outliers, mixed pixels and misalignment come from its
/// own stream of random numbers.
class LaserScanner {
 public:
  /// @param base_from_nominal  where the drawing says it is mounted; the true mount is drawn around it
  LaserScanner(const LaserParams& params, const Pose2& base_from_nominal, Rng rng);

  struct Sweep {
    std::vector<float> ranges;        ///< [m], one a beam
    std::vector<std::int32_t> discs;  ///< index of the disc each beam ideally ends on, -1 for none
  };
  /// Takes one scan. @param discs  what of people is in its plane; any order. O(beams * cells + discs).
  [[nodiscard]] const Sweep& sweep(const RayCaster& walls, std::span<const Disc> discs, const Pose2& world_from_base);

  /// What of the body stands in the scanner's plane, base frame: it sees that in every sweep.
  void see_body(std::span<const Disc> parts);
  /// A scanner that looks no farther than `range` [m]; the noise at a distance stays what it is there.
  void limit_reach(double range);

  [[nodiscard]] const LaserParams& params() const { return params_; }
  [[nodiscard]] const Pose2& base_from_scanner() const { return base_from_scanner_; }

 private:
  [[nodiscard]] double measure(double ideal, double neighbour);
  /// Shortens the beams that meet a disc, scanner frame; `disc`: its number, -1 for none.
  void meet(Point2 centre, double radius, std::int32_t disc);

  LaserParams params_;
  Pose2 base_from_scanner_;
  Rng rng_;
  Sweep sweep_;
  std::vector<double> ideal_;
  std::vector<Point2> rays_;  ///< [beams] unit vectors, scanner
  std::vector<Disc> parts_;   ///< of the body, scanner
};

}  // namespace docent::simulator
