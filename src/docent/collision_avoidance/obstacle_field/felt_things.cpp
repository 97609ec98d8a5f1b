#include "docent/collision_avoidance/obstacle_field/felt_things.h"

#include <algorithm>

namespace docent::collision_avoidance {
namespace {

/// The largest radius, of a disc that touches `at` from outside, with which a body of radius `body` [m] in `centre` is
/// beside it: |c - p - r u| >= R + r with w = c - p gives r <= (w^2 - R^2) / (2 (w u + R)).
double free_radius(const FeltThings::Disc& disc, Point2 centre, double body) {
  const Point2 away = centre - disc.at;
  const double beside = dot(away, away) - body * body;
  const double towards = dot(away, disc.outward) + body;
  if (towards <= 0.0) return disc.radius;  // the body is behind the touched place
  return std::min(disc.radius, beside / (2.0 * towards));
}

}  // namespace

void FeltThings::feel(Point2 at, Point2 outward, bool may_be_somebody, Time now) {
  const Time until = now + seconds(may_be_somebody ? params_.forget_doubt : params_.forget);
  const Disc felt{at, outward, params_.radius, until};
  const auto same = std::find_if(discs_.begin(), discs_.end(), [&](const Disc& disc) {
    return distance(disc.at, at) <= params_.same && distance(disc.middle(), felt.middle()) <= params_.same;
  });
  if (same != discs_.end()) {
    same->until = std::max(same->until, until);
    return;
  }
  if (discs_.size() >= params_.most) discs_.erase(discs_.begin());
  discs_.push_back(felt);
}

void FeltThings::stand(Point2 centre, double radius) {
  std::erase_if(discs_, [&](const Disc& disc) { return distance(disc.at, centre) < radius; });
  for (Disc& disc : discs_) disc.radius = std::max(params_.least, free_radius(disc, centre, radius));
}

void FeltThings::forget(Time now) {
  std::erase_if(discs_, [&](const Disc& disc) { return now > disc.until; });
}

void FeltThings::carry(const Pose2& new_from_old) {
  for (Disc& disc : discs_) {
    disc.at = new_from_old * disc.at;
    disc.outward = new_from_old * disc.outward - new_from_old.position();
  }
}

}  // namespace docent::collision_avoidance
