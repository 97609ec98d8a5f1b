#pragma once

#include <string>
#include <vector>

#include "docent/pictures/image.h"
#include "docent/planning/coastal/coastal_planner.h"

namespace docent {

/// A way as `docent plan` draws it.
struct DrawnWay {
  std::string name;
  std::vector<Point2> points;  ///< [m], map, with its start
  Color color;
};

/// Ways over the map, with a robot of `radius` [m] at their start and a disc at their end.
/// `information`: where given, laid over the floor: what one scan tells a robot that knows its place to 25 cm, pale for
/// nothing, dark for the most that there is, as in [Minerva2000, Fig. 12].
[[nodiscard]] Image draw_plan(const OccupancyGrid& map, const std::vector<DrawnWay>& ways, double radius,
                              const InformationMap* information, double heading_scale);

}  // namespace docent
