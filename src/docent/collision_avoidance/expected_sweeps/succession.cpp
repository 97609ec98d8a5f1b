#include "docent/collision_avoidance/expected_sweeps/succession.h"

#include <algorithm>
#include <cmath>

namespace docent::collision_avoidance {
namespace {

/// The pose of a sensor whose base has turned and driven besides what odometry tells, as far as the sensor sees it: the
/// difference between turning about the base and about itself is less than a step.
Pose2 moved(const Pose2& odom_from_sensor, double turn, double way, Angle along) {
  const Point2 shift = way * unit(along);
  return {odom_from_sensor.x + shift.x, odom_from_sensor.y + shift.y, odom_from_sensor.theta + Angle::radians(turn)};
}

}  // namespace

void Succession::forget() {
  earlier_.clear();
  suspect_.reset();
  strange_ = 0;
  explained_ = 1.0;
}

std::optional<double> Succession::share(const SweepView& before, const SweepView& now, const Pose2& odom_from_sensor) {
  const Pose2 now_from_before = inverse(odom_from_sensor) * before.odom_from_sensor;
  const Agreement forth = agreement_of(before, now_from_before, now, expected_, params_.law);
  const Agreement back = agreement_of(now, inverse(now_from_before), before, expected_, params_.law);
  const int compared = forth.compared + back.compared;
  if (compared < params_.least) return std::nullopt;
  return (forth.share * forth.compared + back.share * back.compared) / compared;
}

std::optional<bool> Succession::is_explained(std::span<const SweepView> earlier, const SweepView& now) {
  explained_ = 0.0;
  for (auto before = earlier.rbegin(); before != earlier.rend(); ++before) {
    const auto found = share(*before, now, now.odom_from_sensor);
    if (!found && before == earlier.rbegin()) return std::nullopt;
    explained_ = std::max(explained_, found.value_or(0.0));
    if (explained_ >= params_.follows) return true;
  }
  for (auto before = earlier.rbegin(); before != earlier.rend(); ++before) {
    const double elapsed = std::min(params_.beyond, std::abs(to_seconds(now.stamp - before->stamp)));
    const double turn = max_turn_ * elapsed + params_.slack_turn;
    const double way = max_speed_ * elapsed + params_.slack_way;
    const int turns = static_cast<int>(std::ceil(turn / params_.step_turn));
    const int ways = static_cast<int>(std::ceil(way / params_.step_way));
    for (int t = -turns; t <= turns; ++t) {
      for (int w = -ways; w <= ways; ++w) {
        // A wheeled base drives ahead or back; its scanner may look anywhere, so the way is tried along both its axes.
        for (const double aside : {0.0, 90.0}) {
          if (aside > 0.0 && w == 0) continue;
          const Angle along = now.odom_from_sensor.theta + Angle::degrees(aside);
          const auto found = share(*before, now, moved(now.odom_from_sensor, t * turn / turns, w * way / ways, along));
          explained_ = std::max(explained_, found.value_or(0.0));
          if (explained_ >= params_.follows) return true;
        }
      }
    }
  }
  return false;
}

void Succession::keep(const SweepView& view) {
  if (earlier_.size() >= params_.remembered) earlier_.erase(earlier_.begin());
  earlier_.push_back(view);
  suspect_.reset();
  strange_ = 0;
}

Succession::Finding Succession::add(const SweepView& view, std::optional<double> as_before) {
  const bool is_long_ago =
      earlier_.empty() || to_seconds(view.stamp - (suspect_ ? *suspect_ : earlier_.back()).stamp) > params_.longest;
  if (is_long_ago) {
    forget();
    keep(view);
    return Finding::untold;
  }
  if (!suspect_ && as_before && *as_before >= params_.follows) {
    explained_ = 1.0;
    keep(view);
    return Finding::follows;
  }
  const auto explained = is_explained(earlier_, view);
  if (!explained || *explained) {
    keep(view);
    return explained ? Finding::follows : Finding::untold;
  }
  const double nearest = explained_;
  const bool is_borne_out = suspect_ && is_explained({&*suspect_, 1}, view).value_or(false);
  explained_ = nearest;
  ++strange_;
  if (!is_borne_out && strange_ < params_.garbage) {
    suspect_ = view;
    return Finding::suspect;
  }
  earlier_.clear();
  keep(view);
  return is_borne_out ? Finding::broken : Finding::untold;
}

}  // namespace docent::collision_avoidance
