#pragma once

#include <string>
#include <vector>

#include "docent/pictures/figure.h"
#include "docent/planning/coastal/coastal_planner.h"
#include "docent/planning/value_iteration/value_iteration.h"

namespace docent::apps::plan_command {

/// A way as `docent-lab plan` draws it.
struct DrawnWay {
  std::string name;
  std::vector<Point2> points;  ///< [m], map, with its start
  double length = 0.0;         ///< [m]
  pictures::Color color;
};

/// What lies over the floor under the ways.
struct PlanGround {
  const planning::ValueIteration* values =
      nullptr;  ///< pale near the goals, dark far from them, clear where no way leads
  /// Instead, where given: what one scan tells a robot that knows its place to 25 cm, pale for nothing, dark for the
  /// most that there is, as in [Minerva2000] Fig. 12.
  const planning::InformationMap* information = nullptr;
  double heading_scale = 1.0;
};

/// Ways over the map, with a robot of `radius` [m] at their start and a disc at each goal.
[[nodiscard]] pictures::Figure draw_plan(const OccupancyGrid& map, const std::vector<DrawnWay>& ways,
                                         const std::vector<Point2>& goals, double radius, const PlanGround& ground);

}  // namespace docent::apps::plan_command
