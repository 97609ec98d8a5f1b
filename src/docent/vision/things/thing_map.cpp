#include "docent/vision/things/thing_map.h"

#include <Eigen/LU>
#include <algorithm>

namespace docent::vision {

Result<void> ThingMapParams::validate() const {
  if (!(gate > 0.0) || !(apart >= 0.0) || !(drift >= 0.0))
    return fail("things: gate must be > 0, apart and drift >= 0");
  if (least_known < 1 || gone_after < 1 || most < 1)
    return fail("things: least_known, gone_after and most must be >= 1");
  if (!(least_share >= 0.5 && least_share <= 1.0)) return fail("things: least_share must be in 0.5..1");
  return {};
}

void ThingMap::add(const ThingLook& look, Time now) {
  MappedThing* best = nullptr;
  double least = params_.gate;
  for (MappedThing& thing : things_) {
    const Eigen::Vector2d off{look.in_map.x - thing.in_map.x, look.in_map.y - thing.in_map.y};
    const Eigen::Matrix2d both = look.covariance + thing.covariance;
    double far = off.dot(both.inverse() * off);
    if (off.norm() < params_.apart) far = std::min(far, 0.5 * params_.gate * off.norm() / params_.apart);
    if (far >= least) continue;
    least = far;
    best = &thing;
  }
  if (best == nullptr) {
    if (things_.size() >= static_cast<std::size_t>(params_.most))
      things_.erase(std::min_element(things_.begin(), things_.end(),
                                     [](const MappedThing& a, const MappedThing& b) { return a.last < b.last; }));
    best = &things_.emplace_back();
    best->id = next_++;
    best->in_map = look.in_map;
    best->covariance = look.covariance;
    best->width = look.width;
    best->height = look.height;
  } else {
    const Eigen::Matrix2d gain = best->covariance * (best->covariance + look.covariance).inverse();
    const Eigen::Vector2d off{look.in_map.x - best->in_map.x, look.in_map.y - best->in_map.y};
    const Eigen::Vector2d moved = gain * off;
    best->in_map = best->in_map + Point2{moved.x(), moved.y()};
    best->covariance = (Eigen::Matrix2d::Identity() - gain) * best->covariance;
    for (int k = 0; k < 2; ++k) best->covariance(k, k) = std::max(best->covariance(k, k), params_.drift);
    const double share = 1.0 / (best->looks + 1);
    best->width += share * (look.width - best->width);
    best->height += share * (look.height - best->height);
  }
  ++best->looks;
  best->bare = 0;
  best->last = now;
  if (!look.is_named) return;
  ++best->named;
  if (!look.object.empty()) ++best->votes[look.object];
}

void ThingMap::see_bare(std::uint32_t id) {
  const auto thing = std::find_if(things_.begin(), things_.end(), [&](const MappedThing& one) { return one.id == id; });
  if (thing != things_.end() && ++thing->bare >= params_.gone_after) things_.erase(thing);
}

std::string ThingMap::object_of(const MappedThing& thing) const {
  for (const auto& [object, votes] : thing.votes)
    if (votes >= params_.least_known && votes >= params_.least_share * thing.named) return object;
  return "";
}

}  // namespace docent::vision
