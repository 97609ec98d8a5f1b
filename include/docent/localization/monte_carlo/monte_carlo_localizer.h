#pragma once

#include <cstdint>
#include <memory>

#include "docent/grid/occupancy_grid.h"
#include "docent/localization/localizer/localizer.h"
#include "docent/localization/monte_carlo/particle_belief.h"

namespace docent::localization {

/// Monte Carlo localization [Minerva2000] 3.3: the cycle of `Localizer` over a `ParticleBelief`. Shared with the grid
/// are the sensor and motion models, filters, tempering (decision 0006), cadence and verdict.
class MonteCarloLocalizer final : public Localizer {
 public:
  /// `cache`: as for MarkovLocalizer, the same tables. @pre params are valid
  MonteCarloLocalizer(const FloorMap& map, const LocalizerParams& shared, const MonteCarloParams& params,
                      const RangeTableCache& cache, std::uint64_t seed)
      : MonteCarloLocalizer{std::make_shared<const KnownMap>(map, shared, cache), shared, params, seed} {}

  /// The samples themselves.
  [[nodiscard]] const ParticleSet& particles() const {
    return static_cast<const ParticleBelief&>(pose_belief()).particles();
  }
  /// For benchmarks: all give the same samples.
  void use_kernels(FieldKernel field, InstructionSet grid) {
    static_cast<ParticleBelief&>(pose_belief()).use_kernels(field, grid);
  }

 private:
  MonteCarloLocalizer(const std::shared_ptr<const KnownMap>& map, const LocalizerParams& shared,
                      const MonteCarloParams& params, std::uint64_t seed)
      : Localizer{map, shared, std::make_unique<ParticleBelief>(map, shared, params, seed), false, seed} {}
};

}  // namespace docent::localization
