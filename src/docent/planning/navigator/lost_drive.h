#pragma once

#include <optional>
#include <span>

#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/planning/exploration/look_around.h"
#include "docent/planning/exploration/tell_apart.h"
#include "docent/planning/navigator/whereabouts.h"

namespace docent::planning {

/// How a lost robot moves to find out where it is: it looks round, and drives to where its hypotheses are told apart.
class LostDrive {
 public:
  /// @param active  else it only looks round
  LostDrive(const OccupancyGrid& map, double robot_radius, const TellApartParams& params, bool active)
      : tell_apart_{map, robot_radius, params}, active_{active} {}

  void start(Time now) { look_around_.start(now); }
  /// @param where  with odometry
  /// @param clearances  as LookAround::step takes them
  /// @param reach  [m] that the scanners look
  [[nodiscard]] LookAroundStep step(const Whereabouts& where, const PoseBelief& belief,
                                    std::span<const double> clearances, double reach, Time now);
  /// [s], see LookAround::held_up_s.
  [[nodiscard]] double held_up_s(Time now) const { return look_around_.held_up_s(now); }
  [[nodiscard]] bool is_hemmed_in() const { return look_around_.is_hemmed_in(); }

 private:
  [[nodiscard]] std::optional<Point2> telling_place(const Whereabouts& where, const PoseBelief& belief,
                                                    std::span<const double> clearances, double reach);

  LookAround look_around_;
  TellApart tell_apart_;
  bool active_;
  std::optional<Point2> goal_;  ///< [m], odom: the place that was chosen last to tell its hypotheses apart
};

}  // namespace docent::planning
