#pragma once

#include <cstdint>
#include <memory>

#include "docent/grid/occupancy_grid.h"
#include "docent/localization/localizer/localizer.h"
#include "docent/localization/markov/grid_belief.h"

namespace docent::localization {

/// Grid-based Markov localization [Markov1998]: the cycle of `Localizer` over a `GridBelief`.
class MarkovLocalizer final : public Localizer {
 public:
  /// `cache`: see range_table_of. @pre params are valid
  MarkovLocalizer(const FloorMap& map, const LocalizerParams& params, const RangeTableCache& cache, std::uint64_t seed)
      : MarkovLocalizer{std::make_shared<const KnownMap>(map, params, cache), params, seed} {}

  /// The grid itself.
  [[nodiscard]] const PositionBelief& belief() const { return static_cast<const GridBelief&>(pose_belief()).belief(); }

 private:
  MarkovLocalizer(const std::shared_ptr<const KnownMap>& map, const LocalizerParams& params, std::uint64_t seed)
      : Localizer{map, params, std::make_unique<GridBelief>(map, params), true, seed} {}
};

}  // namespace docent::localization
