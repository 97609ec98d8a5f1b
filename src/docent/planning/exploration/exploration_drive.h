#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/planning/exploration/explorer.h"

namespace docent::planning {

/// Part `drive` of section `explore`: what it does where it does not get on.
struct ExplorationDriveParams {
  double horizon = 3.0;         ///< [m], > 0: so far ahead of the robot its way is told to the avoidance
  double held_up = 8.0;         ///< [s], > 0: so long it waits where it does not get on, then it goes elsewhere
  double barred = 2.0;          ///< [s], > 0: likewise where what no sensor sees bars its way: that stays as it is
  double moved = 0.3;           ///< [m], > 0: that counts as getting on
  double turned_away = 120.0;   ///< [s], > 0: so long it keeps off where it was held up
  double home_tolerance = 0.4;  ///< [m], > 0
  double patience = 30.0;       ///< [s], >= 0: so long it looks for a way on, before it goes home, and
  double forget = 10.0;         ///< [s], >= 0: then it forgets where it was held up, and
  double enclosed = 300.0;      ///< [s], >= 0: so long where there is no way home either: people stand about it
  template <class V>
  void visit(V& v) {
    v("horizon", horizon);
    v("held_up", held_up);
    v("barred", barred);
    v("moved", moved);
    v("turned_away", turned_away);
    v("home_tolerance", home_tolerance);
    v("patience", patience);
    v("forget", forget);
    v("enclosed", enclosed);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// The way of a robot that explores: to the nearest unknown place; elsewhere, where it is held up; home, when nothing
/// is left. People stand in the way and go: it waits a while before it believes that there is no way on, and turns back
/// on its way home when one has opened.
class ExplorationDrive {
 public:
  enum class State { exploring, returning, arrived };
  /// What stands in its way, as far as anybody knows. A person goes away; a thing and what no sensor sees do not, so
  /// the place is left after one look.
  enum class Hindrance { unknown, person, thing, ground };

  ExplorationDrive(const ExplorationDriveParams& params, Explorer explorer, Point2 home);

  /// Plans anew. O(cells of the map)
  /// @param waits  it is held by hand, or knows no way for another reason: no time counts
  void plan(const OccupancyGrid& map, Point2 robot, bool waits, Time now, Hindrance hindrance = Hindrance::unknown);
  /// See `Explorer::set_doubt`.
  void set_doubt(double sigma) { explorer_.set_doubt(sigma); }
  /// See `Explorer::set_mark_margin`.
  void set_mark_margin(std::function<double(Point2)> margin) { explorer_.set_mark_margin(std::move(margin)); }
  /// See `Explorer::set_trail`.
  void set_trail(std::vector<Point2> trail) { explorer_.set_trail(std::move(trail)); }
  /// [m], map: where it comes back to in the end.
  void set_home(Point2 home);
  /// [m], map: the way ahead, nearest first, up to the horizon; empty: stand.
  struct Ahead {
    std::vector<Point2> via;
    bool is_final = false;
  };
  [[nodiscard]] Ahead ahead(Point2 robot) const;

  [[nodiscard]] State state() const { return state_; }
  /// It has ended where it stood, for no way was open that leads home; else it was held up on all of them.
  [[nodiscard]] bool is_enclosed() const { return is_enclosed_; }
  [[nodiscard]] std::size_t frontier() const { return frontier_; }  ///< unknown cells that it can go to
  [[nodiscard]] const Explorer& explorer() const { return explorer_; }
  [[nodiscard]] const std::vector<Point2>& way() const { return way_; }  ///< [m], map

 private:
  struct Obstacle {
    Point2 place;
    Time until{};
    bool stays = false;
  };
  struct Failure {
    Point2 goal;
    int times = 0;
  };
  struct Choice {
    Point2 goal;
    int times = 0;
    double at = 0.0;  ///< [m] of driven_, the last time
  };
  /// It sets out for another place than before.
  void note_choice(Point2 goal);
  /// It was held up on its way to `goal`, by what `stays` or may go.
  void note_failure(Point2 goal, Point2 robot, bool stays);
  void note_progress(Point2 robot, bool waits, Time now, Hindrance hindrance);
  void note_held_up(Point2 robot, bool stays, Time now);
  void forget_what_may_go();
  [[nodiscard]] bool explore(const OccupancyGrid& map, Point2 robot);
  [[nodiscard]] bool backs_off(const OccupancyGrid& map, Point2 robot, Time now);
  [[nodiscard]] bool is_backing_off(Point2 robot, Time now);
  [[nodiscard]] bool is_stuck_for(double most_s, Time now);
  [[nodiscard]] std::vector<Point2> way_home(const OccupancyGrid& map, Point2 robot) const;
  void go_home(const OccupancyGrid& map, Point2 robot, Time now);
  void set_way(std::vector<Point2> cells);

  ExplorationDriveParams params_;
  Explorer explorer_;
  Point2 home_;
  State state_ = State::exploring;
  std::vector<Point2> way_;
  std::size_t frontier_ = 0;
  std::vector<Obstacle> obstacles_;  ///< where it was held up
  std::vector<Failure> failures_;
  std::vector<Choice> choices_;
  std::optional<Point2> last_;           ///< where it was at the last plan
  std::optional<Time> backs_off_until_;  ///< it goes to where there is room
  bool wants_room_ = false;              ///< it was held up on its way home
  double driven_ = 0.0;                  ///< [m]
  Point2 last_progress_;
  std::optional<Time> progress_;
  std::optional<Time> stuck_;  ///< since when there is no way on
  std::size_t held_up_on_way_home_ = 0;
  bool is_enclosed_ = false;  ///< in the end
};

}  // namespace docent::planning
