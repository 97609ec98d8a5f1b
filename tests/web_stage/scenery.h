#pragma once

#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/messages/standard_messages.h"
#include "docent/museum/museum.h"
#include "docent/planning/value_iteration/route.h"

namespace docent::stage {

/// Somebody who strolls from one place to the next.
struct Walker {
  std::uint32_t id = 0;
  Point2 at;
  Point2 velocity;
  std::vector<Point2> way;
  double pause_s = 0.0;
};

/// The invented building: people who stroll, beams that end on walls and people.
class Scenery {
 public:
  Scenery(const museum::Museum& museum, int people, Rng rng);

  void step(double dt, Point2 robot);
  [[nodiscard]] const std::vector<Walker>& walkers() const { return walkers_; }
  /// 180 readings over 180 degrees round the sensor's axis, up to 10 m.
  [[nodiscard]] sensor_msgs::LaserScan scan(const Pose2& map_from_sensor, Time now);
  [[nodiscard]] std::vector<Point2> way(Point2 from, Point2 to);
  [[nodiscard]] Point2 any_place();
  [[nodiscard]] bool sees(Point2 from, Point2 to) const;

 private:
  [[nodiscard]] double range(Point2 from, Angle bearing) const;

  const museum::Museum& museum_;
  Rng rng_;
  planning::RoutePlanner planner_;
  std::vector<Walker> walkers_;
};

}  // namespace docent::stage
