#pragma once

#include <span>
#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/mapping/expectation_maximization/place.h"

namespace docent::mapping {

/// Expected counts of how often each cell was seen occupied and free, and the map of maximum likelihood that follows:
/// [Minerva2000] eq. 9, solved for each cell by itself. Cells are those of PoseCells: centres at whole multiples.
class EvidenceMap {
 public:
  /// Covers all places at all poses of their beliefs. @pre as many beliefs as places, at least one
  EvidenceMap(std::span<const SeenPlace> places, std::span<const PoseBox> beliefs);

  /// ln P(o | s, m) less that of a robot that sees nothing known, tempered: all cells of a place together are worth
  /// `independent` ones. O(points of the place).
  [[nodiscard]] double log_likelihood(const SeenPlace& place, const Pose2& map_from_base, double independent) const;
  /// The same for all cells of one heading is the inner loop: the points' cells as seen from a cell's centre.
  struct TurnedPlace {
    std::vector<CellIndex> occupied;
    std::vector<CellIndex> free;
  };
  [[nodiscard]] static TurnedPlace turned(const SeenPlace& place, Angle heading, double cell);
  [[nodiscard]] double log_likelihood(const TurnedPlace& place, CellIndex at, double independent) const;

  /// In percent; cells that hardly anything was seen of are unknown.
  [[nodiscard]] OccupancyGrid picture() const;

 private:
  void add(const SeenPlace& place, const PoseBox& belief);
  void take_logarithms();

  GridFrame frame_;  ///< cell (0, 0) has its centre at `first_` times the resolution
  CellIndex first_;
  std::vector<float> occupied_;      ///< [rows * columns], expected counts
  std::vector<float> free_;          ///< [rows * columns]
  std::vector<float> log_occupied_;  ///< ln (P(occupied) / mean)
  std::vector<float> log_free_;      ///< ln (P(free) / mean)
};

}  // namespace docent::mapping
