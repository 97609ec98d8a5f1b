#include "docent/collision_avoidance/obstacle_field/unmapped_places.h"

namespace docent::collision_avoidance {

void UnmappedPlaces::add(Time now, Time taken, const Pose2& odom_from_base, std::span<const Point2> in_base,
                         bool localized) {
  std::erase_if(beams_, [&](const Beam& beam) { return now - beam.heard > seconds(params_.judged_together); });
  for (const auto& point : in_base) beams_.push_back({odom_from_base * point, now});
  std::vector<Point2> places;
  places.reserve(beams_.size());
  for (const Beam& beam : beams_) places.push_back(beam.in_odom);
  near_.emplace(places, odom_from_base.position(), params_.by_somebody);
  taken_ = taken;
  localized_ = localized;
}

bool UnmappedPlaces::judge(Time when) const {
  return localized_ && near_ && when - taken_ < seconds(params_.still_judged);
}

}  // namespace docent::collision_avoidance
