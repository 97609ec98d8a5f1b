#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/localization/expected_ranges/range_table.h"
#include "docent/localization/expected_ranges/state_space.h"
#include "docent/localization/monte_carlo/likelihood_field.h"
#include "docent/localization/particles/particle_set.h"
#include "docent/sensor_models/proximity_model.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// Weighs particles by the proximity model, P(d | o) of [Markov1998] 3.2, with the expected ranges of the grid's table.
///
/// The table knows the middle of each cell only. Seen from a particle beside it, a wall across the beam is nearer or
/// farther by as much as the particle lies ahead of the middle, so the reading is carried to the middle before it is
/// looked up: particles of one cell weigh differently, and the best of them is the one in the right place.
class BeamScores {
 public:
  /// All must outlive the object.
  BeamScores(const StateSpace& space, const RangeTable& table, const sensor_models::ProximityModel& model,
             double max_range);
  /// What a beam measured that met nothing up to `range` [m].
  [[nodiscard]] int nothing_up_to(double range) const { return model_->nothing_up_to(range); }

  /// As FieldBeams: sector by sector, capped.
  struct Beams {
    struct Beam {
      float range;        ///< [m]
      float x, y;         ///< unit vector, robot frame
      float direction;    ///< bearing in heading steps, 0..headings
      int nothing_up_to;  ///< ProximityModel::nothing_up_to; negative: something came back
    };
    std::vector<Beam> beams;
    std::vector<std::uint32_t> ends;
    std::uint32_t cap = 1U << 30U;
  };
  /// Costs in steps of 1 / kScorePerNat; off the free places, all sectors' caps. `costs` has padded_size() entries.
  /// O(particles * beams).
  void score(const Beams& beams, const ParticleSet& particles, std::uint32_t* costs) const;

 private:
  static constexpr double kBinsPerMetre = 100.0;  ///< of the table from ranges to bins

  [[nodiscard]] std::uint32_t score_one(const Beams& beams, const RangeTable::Row& row, float heading, float ahead,
                                        float aside) const;

  const StateSpace* space_;
  const RangeTable* table_;
  const sensor_models::ProximityModel* model_;
  std::vector<std::uint8_t> bins_;   ///< of a range in centimetres
  std::vector<std::uint8_t> costs_;  ///< [measured][expected]
};

}  // namespace docent::localization
