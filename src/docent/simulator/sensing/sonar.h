#pragma once

#include <span>

#include "docent/base/random.h"
#include "docent/simulator/sensing/laser.h"
#include "docent/simulator/sensing/ray_caster.h"

namespace docent::simulator {

/// The true sonar ring: plain cones, no specular reflection.
struct SonarParams {
  int count = 24;                           ///< evenly round the body, the first at the front, counter-clockwise
  double ring_radius = 0.25;                ///< [m] from the body's centre
  double field_of_view = 0.26179938779915;  ///< [rad]
  double min_range = 0.05;                  ///< [m]
  double max_range = 5.0;                   ///< [m]; no echo reads so
  double noise = 0.02;                      ///< [m]
  double quantum = 0.01;                    ///< [m]
  double glass = 0.8;                       ///< chance that a ping sees glass
  double lost = 0.01;                       ///< chance that an echo is missed
};

class SonarRing {
 public:
  SonarRing(const SonarParams& params, Rng rng) : params_{params}, rng_{rng} {}

  /// Range of sonar `index` [m], from its place on the ring.
  [[nodiscard]] double ping(int index, const RayCaster& walls, std::span<const Disc> people,
                            const Pose2& world_from_base);
  [[nodiscard]] const SonarParams& params() const { return params_; }

 private:
  SonarParams params_;
  Rng rng_;
};

}  // namespace docent::simulator
