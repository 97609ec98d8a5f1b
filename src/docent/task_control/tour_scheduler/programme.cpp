#include "docent/task_control/tour_scheduler/programme.h"

#include <algorithm>
#include <cmath>

namespace docent::task_control {

const ProgrammeExhibit* Programme::find_exhibit(const std::string& id) const {
  const auto place = std::find_if(exhibits.begin(), exhibits.end(), [&](const auto& e) { return e.id == id; });
  return place == exhibits.end() ? nullptr : &*place;
}

const ProgrammeTour* Programme::find_tour(const std::string& id) const {
  const auto place = std::find_if(tours.begin(), tours.end(), [&](const auto& t) { return t.id == id; });
  return place == tours.end() ? nullptr : &*place;
}

bool is_same(const Pose2& a, const Pose2& b) {
  constexpr double kRounding = 1e-6;
  return distance(a.position(), b.position()) < kRounding && std::abs((a.theta - b.theta).radians()) < kRounding;
}

TravelDistance straight_distance() {
  return [](Point2 from, Point2 to) { return distance(from, to); };
}

}  // namespace docent::task_control
