#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// One side of a solid, as a sensor at a given height meets it.
struct Surface {
  Segment segment;     ///< [m], world
  bool glass = false;  ///< most light passes
  /// Share of sound that goes back where it came from, however slanted the surface: 0 a mirror, 1 a coarse curtain.
  double roughness = 0.0;
};

/// The sides that a horizontal ray `height` metres above the floor may meet: walls, furniture and glass. Plates and
/// stairs are never met.
[[nodiscard]] std::vector<Surface> surfaces_at(const World& world, double height);
/// The same for sound, at the sonars' height: glass is a hard smooth surface like plaster, furniture is rougher.
[[nodiscard]] std::vector<Surface> sonar_surfaces(const World& world);

struct RayHit {
  double distance = std::numeric_limits<double>::infinity();        ///< [m] to the first opaque surface
  double glass_distance = std::numeric_limits<double>::infinity();  ///< [m] to the first glass before it
  double glass_cosine = 0.0;                                        ///< of the angle of incidence on that glass, 0..1
  std::uint32_t side = 0;  ///< which opaque side was met; for RayCaster::footprint
};

/// Where and how a ray met an opaque surface.
struct Footprint {
  Point2 normal;           ///< unit vector towards where the ray came from
  double cosine = 1.0;     ///< of the angle of incidence, 0..1
  double roughness = 0.0;  ///< of the surface
  Point2 edge;             ///< [m], the nearer end of the surface
};

/// Casts rays through a uniform grid of surfaces: each cell holds copies of the surfaces that cross it, and a ray
/// walks from cell to cell. O(cells passed * surfaces a cell), no allocation.
class RayCaster {
 public:
  explicit RayCaster(const std::vector<Surface>& surfaces);

  /// @param direction  unit vector
  /// @returns distances beyond `max_range` as infinity
  [[nodiscard]] RayHit cast(Point2 origin, Point2 direction, double max_range) const;
  /// @pre hit.distance is finite and came of cast(origin, direction, …)
  [[nodiscard]] Footprint footprint(const RayHit& hit, Point2 origin, Point2 direction) const;
  /// True when no opaque surface lies between the two points.
  [[nodiscard]] bool sees(Point2 from, Point2 to) const;

 private:
  struct Side {
    double ax, ay;  ///< [m] one end
    double dx, dy;  ///< [m] to the other
    bool glass;
    double roughness;
  };
  void test_cell(std::size_t cell, Point2 origin, Point2 direction, RayHit& hit) const;

  Point2 low_{};
  Point2 high_{};
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> starts_;  ///< [columns * rows + 1]
  std::vector<Side> sides_;            ///< grouped by cell
};

}  // namespace docent::simulator
