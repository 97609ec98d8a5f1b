#pragma once

#include <string>
#include <vector>

#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// The robot's disc touches a solid.
struct Touch {
  std::size_t solid = 0;  ///< index in the world's list
  Point2 point{};         ///< [m], world
  Point2 towards{};       ///< unit vector from the robot's centre to it
};

/// "walls", "furniture" or "hazards" (architecture 9). Glass, plates and stairs are hazards: not seen, but touched.
[[nodiscard]] std::string contact_kind(SolidKind kind);

/// Solids as bodies: what the robot's disc cannot enter, and stairs that it can fall down.
class Obstacles {
 public:
  explicit Obstacles(const World& world);

  /// Moves `centre` out of everything solid and lists what the disc touches. Stairs do not hold it back.
  /// O(solids), near ones only in full.
  void resolve(Point2& centre, double radius, std::vector<Touch>& touches) const;
  /// The centre is over an edge: nothing carries the robot any more.
  [[nodiscard]] bool has_fallen(Point2 centre) const;
  /// Distance from a point to the nearest thing that the robot can touch, stairs included [m].
  [[nodiscard]] double clearance(Point2 point) const;

 private:
  struct Item {
    std::size_t solid;
    Polygon polygon;
    Point2 low;
    Point2 high;
    bool is_stairs;
  };
  std::vector<Item> items_;
};

}  // namespace docent::simulator
