#pragma once

#include <optional>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::localization {

/// What a sonar should hear in a map.
struct ExpectedEcho {
  double range = 0.0;  ///< [m] to the nearest occupied cell in the cone
  double slant = 0.0;  ///< [rad] 0..pi/2, between the sound and the surface's normal where it is met
};

/// Distance transform of an occupancy map, asked as sonars ask: cones and directions of walls.
class EchoMap {
 public:
  explicit EchoMap(const OccupancyGrid& map);

  /// Nearest surface inside the cone: nullopt when there is none up to `max_range`, or the sonar stands in a wall.
  /// @param rays  >= 1, spread evenly over the cone. O(rays * steps), some ten steps a ray.
  [[nodiscard]] std::optional<ExpectedEcho> expect(const Pose2& map_from_sonar, double half_cone, int rays,
                                                   double max_range) const;
  /// Distance to the nearest surface [m], bilinear; beyond the map as at its border.
  [[nodiscard]] double distance_at(Point2 in_map) const;
  /// Unit vector away from the nearest surface; zero where there is none.
  [[nodiscard]] Point2 away_at(Point2 in_map) const;

  struct MainDirection {
    Angle heading;       ///< of one family of walls, -45..45 degrees; the others at right angles
    double share = 0.0;  ///< of the walls that keep to it within 8 degrees
  };
  /// How the building is turned [Buhmann1995]: the direction in which the projections of its walls are sharpest, modulo
  /// a right angle. nullopt in a map without walls. Found once, O(200 * cells of walls).
  [[nodiscard]] std::optional<MainDirection> main_direction() const { return main_direction_; }

 private:
  [[nodiscard]] double ray(Point2 from, Point2 direction, double max_range) const;
  [[nodiscard]] std::optional<MainDirection> find_main_direction(const OccupancyGrid& map) const;
  /// Directions to the nearest wall [rad], at free cells near walls.
  [[nodiscard]] std::vector<double> normals(const OccupancyGrid& map) const;
  [[nodiscard]] std::vector<Point2> surface_cells(const OccupancyGrid& map) const;
  [[nodiscard]] double sharpest(const std::vector<Point2>& surface, double round, double line, int steps,
                                double step) const;
  [[nodiscard]] double sharpness(const std::vector<Point2>& surface, double heading, double line) const;

  GridFrame frame_;
  std::vector<float> distances_;  ///< [rows * columns], [m]
  std::optional<MainDirection> main_direction_;
};

}  // namespace docent::localization
