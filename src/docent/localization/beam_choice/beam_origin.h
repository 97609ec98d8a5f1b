#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// The inverse of the beam filters [Rhino1999] 3.1.7, [Minerva2000] 3.3: what they reject tells of people.
struct PersonFilterParams {
  /// distance: P_short above `sureness`; entropy: the beam would make the robot less sure by more than `gamma`; none:
  /// no beam tells of people (crippled, for evaluation)
  std::string filter = "distance";
  double sureness = 0.99;          ///< theta of [Markov1998] 3.3, 0.5..1
  double gamma = 0.0002;           ///< [nat] of [Rhino1999] 3.1.7, > 0
  double sigma = 0.06;             ///< [m], > 0: noise of sensor, map and pose
  double sigma_per_metre = 0.015;  ///< [m/m], >= 0: the same of the heading
  double clear = 0.2;              ///< [m] from anything in the map: surely not the map
  double near = 0.1;               ///< [m] from anything in the map: surely the map; between the two: perhaps
  template <class V>
  void visit(V& v) {
    v("filter", filter);
    v("sureness", sureness);
    v("gamma", gamma);
    v("sigma", sigma);
    v("sigma_per_metre", sigma_per_metre);
    v("clear", clear);
    v("near", near);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// P_short of one reading, [Minerva2000] eq. 6: the probability that an authentic reading would be longer (eq. 5,
/// Gaussian), averaged over the modes of the belief. Departure: over the modes' means, which are finer than the cells
/// of the belief, with the modes' spread in `sigma`. nullopt where most of the mass does not know what to expect.
/// O(modes), a ray each.
[[nodiscard]] std::optional<double> shorter_probability(const sensor_models::RayCaster& caster,
                                                        std::span<const BeliefMode> modes,
                                                        const sensor_models::SweepBeam& beam, double max_range,
                                                        const PersonFilterParams& params);

/// Origins of all beams of a sweep by one of the filters, and by how far the endpoint, seen from the best mode, lies
/// from everything in the map: what ends within `params.near` of a wall is the map's, and no ray is followed for it.
/// `modes`: at the time of the sweep, best first; empty: all unknown. `entropy_gains` [beams]: eq. 10 of [Rhino1999], H
/// after minus H before [nat], for the entropy filter; else empty.
[[nodiscard]] std::vector<sensor_models::BeamOrigin> beam_origins(const sensor_models::RayCaster& caster,
                                                                  std::span<const BeliefMode> modes,
                                                                  const sensor_models::RangeSweep& sweep,
                                                                  std::span<const float> entropy_gains,
                                                                  double max_range, const PersonFilterParams& params);

}  // namespace docent::localization
