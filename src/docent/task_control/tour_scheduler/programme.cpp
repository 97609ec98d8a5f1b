#include "docent/task_control/tour_scheduler/programme.h"

#include <algorithm>

namespace docent {

const ProgrammeExhibit* Programme::find_exhibit(const std::string& id) const {
  const auto place = std::find_if(exhibits.begin(), exhibits.end(), [&](const auto& e) { return e.id == id; });
  return place == exhibits.end() ? nullptr : &*place;
}

const ProgrammeTour* Programme::find_tour(const std::string& id) const {
  const auto place = std::find_if(tours.begin(), tours.end(), [&](const auto& t) { return t.id == id; });
  return place == tours.end() ? nullptr : &*place;
}

TravelDistance straight_distance() {
  return [](Point2 from, Point2 to) { return distance(from, to); };
}

}  // namespace docent
