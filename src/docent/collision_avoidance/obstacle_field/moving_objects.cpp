#include "docent/collision_avoidance/obstacle_field/moving_objects.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {

std::vector<MovingObjects::Cluster> MovingObjects::find(std::span<const Point2> points, std::span<const double> ranges,
                                                        std::span<const int> beams, double bearing_step) const {
  std::vector<Cluster> clusters;
  std::size_t first = 0;
  for (std::size_t i = 1; i <= points.size(); ++i) {
    if (i < points.size() && beams[i] - beams[i - 1] <= 2) {
      const double spacing = spacing_of(ranges[i], ranges[i - 1], bearing_step, params_.piece);
      if (distance(points[i], points[i - 1]) < spacing) continue;
    }
    // [first, i) is one piece. It stands free when its neighbours lie farther away or nothing is there.
    const bool free_before =
        first == 0 || beams[first] - beams[first - 1] > 2 || ranges[first - 1] > ranges[first] + params_.foreground;
    const bool free_after =
        i == points.size() || beams[i] - beams[i - 1] > 2 || ranges[i] > ranges[i - 1] + params_.foreground;
    const double width = distance(points[first], points[i - 1]);
    if (i - first >= 2 && width < params_.most_width && free_before && free_after) {
      Point2 sum{};
      for (std::size_t k = first; k < i; ++k) sum = sum + points[k];
      clusters.push_back({first, i - first, 1.0 / static_cast<double>(i - first) * sum, width, {}});
    }
    first = i;
  }
  return clusters;
}

void MovingObjects::follow(Time stamp, std::vector<Cluster>& clusters) {
  std::erase_if(followed_, [&](const Followed& object) { return stamp - object.seen > seconds(params_.forget); });
  std::vector<bool> taken(followed_.size(), false);
  for (auto& cluster : clusters) {
    std::size_t best = followed_.size();
    double least = params_.gate;
    for (std::size_t i = 0; i < taken.size(); ++i) {
      if (taken[i]) continue;
      const double dt = to_seconds(stamp - followed_[i].seen);
      const double miss = distance(followed_[i].place + dt * followed_[i].velocity, cluster.centre);
      if (miss < least) {
        least = miss;
        best = i;
      }
    }
    if (best == followed_.size() || best >= taken.size()) {
      followed_.push_back({cluster.centre, {}, stamp, cluster.centre, 1});
      continue;
    }
    taken[best] = true;
    Followed& object = followed_[best];
    const double dt = to_seconds(stamp - object.seen);
    if (dt < params_.same_moment) {  // the other half of it, in the other laser's sweep
      if (object.sightings >= params_.sightings) cluster.velocity = object.velocity;
      continue;
    }
    ++object.sightings;
    // An alpha-beta filter whose gains fall to their steady values over the first sightings.
    const double alpha = std::max(params_.place_gain, 1.0 / object.sightings);
    const double beta = std::max(params_.velocity_gain, 1.0 / object.sightings);
    const Point2 predicted = object.place + dt * object.velocity;
    const Point2 surprise = cluster.centre - predicted;
    object.place = predicted + alpha * surprise;
    object.velocity = object.velocity + (beta / dt) * surprise;
    const double speed = norm(object.velocity);
    if (speed > params_.most_speed) object.velocity = (params_.most_speed / speed) * object.velocity;
    object.seen = stamp;
    if (object.sightings >= params_.sightings && speed > params_.least_speed &&
        distance(object.place, object.first_place) > params_.least_way) {
      cluster.velocity = object.velocity;
    }
  }
}

}  // namespace docent::collision_avoidance
