#pragma once

#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::mapping {

/// How the free floor of a map is cut into places.
struct RegionParams {
  double door = 1.8;        ///< [m] > 0: what is wider is no door, and joins what lies on its two sides
  double narrower = 0.85;   ///< of the narrower side's width, 0..1: a door is narrower than what it leads into
  double least_area = 1.0;  ///< [m2] >= 0: less is a part of its neighbour
  double thing = 2.5;       ///< [m] >= 0 across: what stands free of the walls and is smaller is furniture, not a wall
  template <class V>
  void visit(V& v) {
    v("door", door);
    v("narrower", narrower);
    v("least_area", least_area);
    v("thing", thing);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A narrow place between two regions.
struct Gap {
  int first = 0, second = 0;  ///< regions
  Point2 at;                  ///< [m], map: its middle
  double width = 0.0;         ///< [m]
};

/// The free floor, cut at its narrow places.
struct Regions {
  static constexpr int kNone = -1;
  GridFrame frame;
  std::vector<int> of;           ///< [cells] region, kNone where the floor is not free
  std::vector<float> clearance;  ///< [cells] [m] to the nearest wall, with furniture taken away
  std::vector<Gap> gaps;
  int count = 0;
};

/// Cuts the free floor of a map into regions: from the widest cells to the narrowest, cells join the region of their
/// neighbours, and where two regions meet they become one, unless the place is a door: at most `door` wide, and
/// narrower than each of them. These are the critical lines of the Voronoi diagram (Thrun and Buecken, 1996) by their
/// persistence. Furniture is taken away before: whatever stands free of the walls and is small. O(cells log cells).
[[nodiscard]] Regions cut_into_regions(const OccupancyGrid& map, const RegionParams& params);

}  // namespace docent::mapping
