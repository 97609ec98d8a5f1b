#pragma once

#include <array>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::planning {

/// What a range finder that looks all round can tell in a building full of people.
struct PlaceInformationParams {
  double range = 10.0;              ///< [m], > 0: farther walls are not seen
  double blocked = 0.0;             ///< 0..0.95: share of all beams that people hide, on average over all places
  int beams = 120;                  ///< 8..720, evenly all round
  double hit_deviation = 0.05;      ///< [m], > 0: noise of a range
  double map_deviation = 0.05;      ///< [m], >= 0: of a wall's place in the map, square to the wall
  double independent_beams = 12.0;  ///< > 0: what all beams of a scan are worth, for they err together
  template <class V>
  void visit(V& v) {
    v("range", range);
    v("blocked", blocked);
    v("beams", beams);
    v("hit_deviation", hit_deviation);
    v("map_deviation", map_deviation);
    v("independent_beams", independent_beams);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Fisher information of a scan about the pose (x, y, heading) of the robot, map frame: symmetric, positive
/// semidefinite. Its inverse bounds the covariance of what can be inferred from that scan alone.
struct PoseInformation {
  double xx = 0.0, xy = 0.0, yy = 0.0;  ///< [1/m2]
  double xt = 0.0, yt = 0.0;            ///< [1/(m rad)]
  double tt = 0.0;                      ///< [1/rad2]

  /// Eigenvalues [1/m2] by falling size, the heading counted as `heading_scale` [rad/m] of position.
  [[nodiscard]] std::array<double, 3> eigenvalues(double heading_scale) const;
};

/// Ranges [m] that a perfect sensor measures all round from a place: `beams` of them, counter-clockwise from the x
/// axis; `range` where nothing is nearer or the map does not know. O(beams) rays.
[[nodiscard]] std::vector<float> ranges_around(const sensor_models::RayCaster& caster, Point2 in_map,
                                               const PlaceInformationParams& params);

/// Rate [1/m] at which people hide beams: one of length r stays free with probability exp(-rate r), as among people who
/// stand anywhere with equal probability. Chosen so that of all beams of all these scans the share `params.blocked` is
/// hidden. `ranges`: scans of any number of places, one after another. O(ranges).
[[nodiscard]] double hiding_rate(std::span<const float> ranges, const PlaceInformationParams& params);

/// I(x) = w sum_k exp(-rate r_k) g_k g_k^T / s_k^2 over the beams that end on something, with g = dr / d(x, y,
/// heading).
///
/// The range r along the unit vector d to a wall with the normal n is (p_wall - p) n / (d n), so that with t = (dr /
/// dheading) / r, which the neighbouring ranges give, g = (-d + t d', r t), d' being d turned by 90 degrees. A wall
/// that the map has wrong by e errs by e sqrt(1 + t^2) along the beam: s^2 = hit^2 + map^2 (1 + t^2). Beams that end on
/// an edge or graze a wall say nothing. w: `independent_beams` a scan. O(beams).
[[nodiscard]] PoseInformation scan_information(std::span<const float> ranges, double rate,
                                               const PlaceInformationParams& params);

/// The information content of every place for this map, these sensors and this crowd.
struct InformationMap {
  GridFrame frame;
  std::vector<PoseInformation> places;  ///< [rows * columns], of one scan; zero where the robot cannot be
};

/// @param costs  [rows * columns of frame] of cells; infinity where the robot cannot be
/// O(open cells * beams) rays: a second for a museum.
[[nodiscard]] InformationMap information_map(const OccupancyGrid& map, const GridFrame& frame,
                                             std::span<const float> costs, const PlaceInformationParams& params);

}  // namespace docent::planning
