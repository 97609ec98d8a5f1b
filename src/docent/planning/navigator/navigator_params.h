#pragma once

#include "docent/base/result.h"
#include "docent/planning/coastal/coastal_planner.h"
#include "docent/planning/exploration/tell_apart.h"
#include "docent/planning/pursuit/pursuit.h"
#include "docent/planning/value_iteration/route.h"

namespace docent::planning {

/// Section `plan` of robot.yaml: ways through the building.
struct NavigatorParams {
  RouteParams route;
  PursuitParams pursuit;
  TellApartParams tell_apart;
  CoastalParams coastal;
  bool active = true;           ///< lost: drives to where its hypotheses are told apart; else it only looks round
  double goal_tolerance = 0.2;  ///< [m] >= 0: cells so near to the goal are goals
  template <class V>
  void visit(V& v) {
    v("route", route);
    v("pursuit", pursuit);
    v("tell_apart", tell_apart);
    v("coastal", coastal);
    v("active", active);
    v("goal_tolerance", goal_tolerance);
  }
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace docent::planning
