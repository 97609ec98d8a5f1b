#pragma once

#include <vector>

#include "docent/mapping/topological/place_kind.h"
#include "docent/mapping/topological/regions.h"

namespace docent::mapping {

/// A room or a hallway.
struct Place {
  PlaceKind kind = PlaceKind::room;  ///< room or hallway
  PlaceShape shape;                  ///< what it was told by
  Point2 middle;                     ///< [m], map: where it is widest
  std::vector<int> doors{};          ///< numbers in `Regions::gaps`
};

/// Rooms, hallways and doors of a building, and which leads to which [Buhmann1995].
struct TopologicalMap {
  Regions regions;            ///< cells of each place, and the gaps between them
  std::vector<Place> places;  ///< [regions]

  /// The places next to one, each once, ascending.
  [[nodiscard]] std::vector<int> neighbours(int place) const;
};

/// May be asked at any moment of a map that is not finished. O(cells log cells), half a second for 50 x 50 m at 5 cm.
[[nodiscard]] TopologicalMap topological_map(const OccupancyGrid& map, const RegionParams& params = {});

}  // namespace docent::mapping
