#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::task_control {

struct ViewPlanParams {
  double near = 1.0;         ///< [m] > 0 from the robot's centre: nearer floor lies below the picture
  double far = 2.5;          ///< [m] > near: farther things are too few pixels
  double half_field = 24.0;  ///< [deg] 0..90 to each side
  double cell = 0.1;         ///< [m] > 0 of the floor
  double lattice = 0.4;      ///< [m] >= cell between places to look from
  int headings = 12;         ///< >= 4 at each place
  double clearance = 0.34;   ///< [m] > 0 that the robot's centre keeps off what the map has
  double least_gain = 0.25;  ///< [m²] > 0 of new floor that a look must show
  double look_costs = 1.2;   ///< [m] >= 0: a look takes as long as such a way
  double turn_costs = 0.35;  ///< [m/rad] >= 0 likewise
  template <class V>
  void visit(V& v) {
    v("near", near);
    v("far", far);
    v("half_field", half_field);
    v("cell", cell);
    v("lattice", lattice);
    v("headings", headings);
    v("clearance", clearance);
    v("least_gain", least_gain);
    v("look_costs", look_costs);
    v("turn_costs", turn_costs);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where a robot looks next so that it sees all of the floor: the look that shows most new floor for its way. Floor
/// counts as seen when it lay within a wedge before the camera with nothing between that the map has. Deterministic.
class ViewPlan {
 public:
  /// @param is_wanted  floor that shall be looked at, by its place; area and hazards are the caller's
  /// @param may_stand  where the robot's centre may be, beside what the map has
  ViewPlan(const OccupancyGrid& map, const std::function<bool(Point2)>& is_wanted,
           const std::function<bool(Point2)>& may_stand, Point2 start, const ViewPlanParams& params = {});

  /// A picture was taken from there. O(cells in reach * cells of a ray)
  void see(const Pose2& map_from_base);
  /// The best look; none: all that can be seen has been. O(places * headings * cells of the wedge)
  [[nodiscard]] std::optional<Pose2> next(const Pose2& map_from_base) const;
  /// The robot could not get there: no look from about there any more.
  void give_up(Point2 place);
  /// A place about `radius` from a point from which it can be seen, on the near side; looks at it.
  [[nodiscard]] std::optional<Pose2> stand_before(Point2 thing, double radius, const Pose2& map_from_base) const;
  [[nodiscard]] double seen_share() const;  ///< 0..1 of the wanted floor that any place shows

 private:
  struct Place {
    Point2 at;
    bool is_given_up = false;
    std::vector<std::vector<std::uint32_t>> shows;  ///< [headings] indices of wanted cells
  };
  [[nodiscard]] bool is_open(Point2 at) const;
  [[nodiscard]] bool is_clear(Point2 from, Point2 to) const;
  [[nodiscard]] Point2 centre_of(std::size_t cell) const;
  /// A camera that looks that way sees what lies at that direction.
  [[nodiscard]] bool holds(Angle heading, Angle at) const;
  /// Wanted cells that can be seen from there, all round.
  [[nodiscard]] std::vector<std::uint32_t> around(Point2 at) const;
  /// [cells] [m] from there over the floor where the robot can stand; infinite: no way.
  [[nodiscard]] std::vector<float> ways_from(Point2 start) const;
  [[nodiscard]] std::optional<std::size_t> cell_near(Point2 at) const;

  ViewPlanParams params_;
  GridFrame frame_;
  std::vector<bool> is_open_;    ///< [cells] nothing of the map there
  std::vector<bool> can_stand_;  ///< [cells] the robot's centre can be there, and gets there
  std::vector<bool> is_wanted_;  ///< [cells]
  std::vector<bool> is_seen_;    ///< [cells]
  std::vector<Place> places_;
};

}  // namespace docent::task_control
