#include "docent/telepresence/counting/audience.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "docent/messages/conversions.h"

namespace docent::telepresence {

void Audience::see(const docent_msgs::People& people, const std::optional<Pose2>& map_from_base) {
  if (!map_from_base) return sights_.clear();
  const Time stamp = from_message(people.header.stamp);
  const auto stands_round = [&](const docent_msgs::Person& person) {
    return distance(Point2{person.x, person.y}, map_from_base->position()) <= params_.round &&
           std::hypot(person.vx, person.vy) < params_.walks;
  };
  const auto count = std::count_if(people.people.begin(), people.people.end(), stands_round);
  if (!sights_.empty() && stamp <= sights_.back().stamp) {
    if (stamp < sights_.back().stamp) sights_.clear();  // another clock
    if (!sights_.empty()) sights_.pop_back();
  }
  sights_.push_back({stamp, static_cast<int>(count)});
  while (stamp - sights_.front().stamp > seconds(params_.window)) sights_.pop_front();
}

int Audience::count() const {
  if (sights_.empty()) return 0;
  std::vector<int> counts;
  for (const Sight& sight : sights_) counts.push_back(sight.people);
  const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::nth_element(counts.begin(), middle, counts.end());
  return *middle;
}

}  // namespace docent::telepresence
