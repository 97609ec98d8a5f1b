#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/grid/clearance.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/exploration/standing_room.h"

namespace docent::planning {

/// Part `explorer` of section `explore`: which unknown places are gone to.
struct ExplorerParams {
  int coarsening = 2;           ///< planning cell = so many map cells
  double robot_radius = 0.265;  ///< [m]
  double wall_margin = 0.10;    ///< [m] kept from what is known to be occupied, beyond the radius
  double tight_margin = 0.03;   ///< [m] likewise near the robot itself: it may have come too close to something
  double tight_reach = 0.8;     ///< [m], >= 0: so near
  double tight_cost = 6.0;      ///< a factor more
  double comfort = 0.5;         ///< [m] beyond which clearance costs nothing
  double comfort_cost = 2.0;    ///< extra cost, as a factor, at the least clearance
  double open_reach = 5.0;      ///< [m], > 0: farther from what is known to be occupied, scans tell little of the pose:
  double open_cost = 1.0;       ///< >= 0: extra cost, as a factor, at twice that
  double home_cost = 0.7;       ///< [m/m], >= 0: for each metre that a place is farther from home: loops stay short
  double switch_cost = 0.5;     ///< [m of free floor] by which another place must be nearer than the last one
  double border_margin = 0.14;  ///< [m] from the centre to the area's border. Avoidance keeps border_margin (0.07) and
                                ///< a bin (0.05): what is left is for the cells' size
  double hazard_margin = 0.30;  ///< [m] kept from what only people know of, beyond the radius: the pose errs, too
  double doubt_sigmas = 1.0;    ///< >= 0: that much more, in sigmas of where such marks lie, as far as these are
  double doubt_free = 0.15;     ///< [m], >= 0: more than this, which the margin holds already;
  double most_doubt = 0.6;      ///< [m], >= 0: but never more, or the building would be shut
  double gap = 0.30;            ///< [m], >= 0: half of a gap that may be wide enough when it is seen from nearby
  double close = 0.9;           ///< [m], > 0: what is still unknown from so near
  int close_looks = 5;          ///< > 0: in so many calls, is not to be seen
  template <class V>
  void visit(V& v) {
    v("coarsening", coarsening);
    v("robot_radius", robot_radius);
    v("wall_margin", wall_margin);
    v("tight_margin", tight_margin);
    v("tight_reach", tight_reach);
    v("tight_cost", tight_cost);
    v("comfort", comfort);
    v("comfort_cost", comfort_cost);
    v("open_reach", open_reach);
    v("open_cost", open_cost);
    v("home_cost", home_cost);
    v("switch_cost", switch_cost);
    v("border_margin", border_margin);
    v("hazard_margin", hazard_margin);
    v("doubt_sigmas", doubt_sigmas);
    v("doubt_free", doubt_free);
    v("most_doubt", most_doubt);
    v("gap", gap);
    v("close", close);
    v("close_looks", close_looks);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where to go to learn the map, and how.
struct Exploration {
  std::vector<Point2> way;   ///< [m], map: cell by cell over known free floor, start excluded; the last one is unknown
  double cost = 0.0;         ///< [m of free floor]
  std::size_t frontier = 0;  ///< unknown cells that border on free floor, as far as the robot could stand there
};

/// Exploration ([Buhmann1995], "Planning and Exploration"): value iteration whose goals are the unknown places, all at
/// once, so the robot moves straight to the unexplored. Goals are those unknown cells that border on free floor and are
/// wide enough for the robot, by what is known to be occupied: a crack between a case and the wall is none. A cell that
/// is still unknown when the robot stands right before it, or has looked from nearby for a while, cannot be seen, and
/// is not gone to again.
class Explorer {
 public:
  /// @param hazards  [m], map: what no sensor sees, and people have marked; the body keeps off
  /// @param area  [m], map: the robot's centre stays inside; empty: anywhere
  explicit Explorer(ExplorerParams params, std::vector<Polygon> hazards = {}, Polygon area = {});

  /// @param map    what is known now, with all that is seen from `robot`; it may have grown or moved since the last
  /// call
  /// @param robot  [m], map
  /// @returns nullopt when nothing unknown can be reached: the map is done. O(cells)
  [[nodiscard]] std::optional<Exploration> next(const OccupancyGrid& map, Point2 robot);
  /// To the nearest place with room all round, from where a door can be approached anew; empty: none is near.
  [[nodiscard]] std::vector<Point2> way_to_room(const OccupancyGrid& map, Point2 robot) const;
  /// The way to a place over known free floor; empty: there is none. O(cells)
  /// @param is_squeezing  with the least margins all along, for where there is no other way; doubt does not count
  [[nodiscard]] std::vector<Point2> way_to(const OccupancyGrid& map, Point2 robot, Point2 goal,
                                           bool is_squeezing = false) const;

  /// How far off, by one standard deviation [m], what people have marked may lie from the robot's place on the map.
  void set_doubt(double sigma) { doubt_ = sigma; }
  /// [m] that marks near a place may lie off beside that, all but surely: the robot was set down by hand.
  void set_mark_margin(std::function<double(Point2)> margin) { mark_margin_ = std::move(margin); }
  /// [m], map: where it has driven, in order. It can again, however narrow the map has drawn that since.
  void set_trail(std::vector<Point2> trail) { trail_ = std::move(trail); }
  /// [m], map: what is near to it is explored first.
  void set_home(Point2 home) { home_ = home; }
  /// Something stands there that the map does not show: no way leads through the disc until `unblock`.
  void block(Point2 centre, double radius) { blocked_.push_back({centre, radius}); }
  void unblock() { blocked_.clear(); }
  /// What is unknown there is not gone to again.
  void give_up(Point2 centre, double radius) { forgone_.push_back({centre, radius}); }
  /// Unknown places beside free floor that are wide enough for the robot, and that it did not get to, in groups: the
  /// middle of each and how many unknown cells border on free floor there. @pre no area of `map` was explored since
  struct Unreached {
    Point2 place;  ///< [m], map
    std::size_t cells = 0;
  };
  [[nodiscard]] std::vector<Unreached> unreached(const OccupancyGrid& map) const;

 private:
  struct Disc {
    Point2 centre;
    double radius = 0.0;
  };
  struct Costs {
    OccupancyGrid coarse;
    StandingRoom room;
    std::map<std::size_t, Point2> driven;  ///< cells that are open because it drove there, and where in them
    std::vector<float> costs;              ///< [rows * columns] of planning cells
    std::vector<CellIndex> frontier;       ///< unknown, beside free floor, wide enough
    std::vector<CellIndex> gaps;           ///< the same, too narrow by what is known, but perhaps only seen badly
  };
  [[nodiscard]] bool is_given_up(Point2 place, double within) const;
  /// What ways keep off: everywhere, and near the robot, which may stand nearer to something than it plans to and must
  /// get away. Where it stands well both are the same, so it comes into no place from which it finds no way back.
  struct Margins {
    Clearance far, near;        ///< `hazards` without `mark_margin_`
    double most_hazards = 0.0;  ///< [m] near the robot, `mark_margin_` and all
  };
  [[nodiscard]] Margins margins(const OccupancyGrid& map, std::optional<Point2> robot, bool is_squeezing) const;
  [[nodiscard]] bool is_blocked(Point2 place) const;
  [[nodiscard]] bool is_clear_of_marks(Point2 place, double hazards, double most_hazards) const;
  [[nodiscard]] Costs costs_of(const OccupancyGrid& map, std::optional<Point2> robot, bool is_squeezing = false) const;
  [[nodiscard]] StandingRoom::Place place_in(const StandingRoom& room, CellIndex cell) const;
  [[nodiscard]] float cost_of(double spare, double walls) const;
  void open_trail(Costs& known) const;
  [[nodiscard]] std::vector<Point2> places_of(const Costs& known, std::span<const CellIndex> cells) const;
  [[nodiscard]] std::vector<CellIndex> views_of_gaps(const Costs& known) const;
  void give_up_what_stays_unknown(const OccupancyGrid& coarse, std::span<const CellIndex> frontier, Point2 robot);

  ExplorerParams params_;
  struct Hazard {
    Polygon outline;
    Point2 centre;        ///< [m], of its corners
    double radius = 0.0;  ///< [m] that holds it, so that what is far needs no look at its sides
  };
  std::vector<Hazard> hazards_;
  Polygon area_;
  double doubt_ = 0.0;
  std::function<double(Point2)> mark_margin_;  ///< none: they lie where they are said to
  std::vector<Point2> trail_;
  std::optional<Point2> home_;
  std::vector<Disc> blocked_;
  std::vector<Disc> forgone_;
  std::vector<Point2> given_up_;                  ///< [m], map
  std::map<std::pair<int, int>, int> looked_at_;  ///< calls in which a cell, by its place, was near and unknown
  std::optional<Point2> last_;                    ///< [m], map: the goal before
};

}  // namespace docent::planning
