#include "docent/collision_avoidance/plausibility/motion_check.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace docent::collision_avoidance {
namespace {

/// Too short is safe, and is what wheels that slip look like.
constexpr std::array<double, 7> kScales{1.5, 2.0, 2.5, 3.3, 5.0, 10.0, 30.0};
constexpr std::array<double, 7> kLags{0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0};  // [s]
constexpr double kTrail = 9.0;                                              // [s]

}  // namespace

Pose2 MotionCheck::odom_from_sensor_at(Time time) const {
  const auto after = std::find_if(trail_.begin(), trail_.end(), [&](const Step& step) { return step.stamp >= time; });
  if (after == trail_.end()) return trail_.back().odom_from_sensor;
  if (after == trail_.begin()) return trail_.front().odom_from_sensor;
  const Step& before = *std::prev(after);
  const double share = to_seconds(time - before.stamp) / std::max(1e-6, to_seconds(after->stamp - before.stamp));
  const Pose2 step = inverse(before.odom_from_sensor) * after->odom_from_sensor;
  return before.odom_from_sensor * Pose2{share * step.x, share * step.y, Angle::radians(share * step.theta.radians())};
}

Agreement MotionCheck::share_of(const SweepView& view, const Pose2& now_from_then) {
  return agreement_of(*from_, now_from_then, view, expected_, params_.law);
}

MotionCheck::Finding MotionCheck::count(Finding finding) {
  row_ = finding == last_ ? row_ + 1 : 1;
  last_ = finding;
  if (finding == Finding::in_order || finding == Finding::nothing) return finding;
  return row_ >= params_.sure ? finding : Finding::nothing;
}

bool MotionCheck::differs(const Pose2& a, const Pose2& b) const {
  const Pose2 off = inverse(a) * b;
  return norm(off.position()) >= params_.differs_way || std::abs(off.theta.radians()) >= params_.differs_turn;
}

Pose2 MotionCheck::now_from_then_if_late(const SweepView& view, double lag) const {
  return inverse(odom_from_sensor_at(view.stamp - seconds(lag))) * odom_from_sensor_at(from_->stamp - seconds(lag));
}

bool MotionCheck::would_late_ones_differ(const SweepView& view, const Pose2& by_odometry, double agrees) {
  return std::all_of(kLags.begin(), kLags.end(), [&](double lag) {
    if (lag < params_.late) return true;
    const Pose2 late = now_from_then_if_late(view, lag);
    return differs(by_odometry, late) && share_of(view, late).share <= agrees - params_.otherwise;
  });
}

MotionCheck::Finding MotionCheck::compare(const SweepView& view, bool may_be_late) {
  const Pose2 by_odometry = inverse(view.odom_from_sensor) * from_->odom_from_sensor;
  const Agreement here = share_of(view, by_odometry);
  if (here.compared >= params_.law.least && here.share >= params_.surely_agrees)
    return !may_be_late || would_late_ones_differ(view, by_odometry, here.share) ? Finding::in_order : Finding::nothing;
  const double least = std::max(params_.explains, here.share + params_.better);
  Finding finding = Finding::nothing;
  double best = least;
  const auto try_out = [&](const Pose2& other, Finding means) {
    if (!differs(by_odometry, other)) return false;
    const Agreement found = share_of(view, other);
    if (found.compared < params_.law.least || found.share < best) return false;
    best = found.share;
    finding = means;
    return true;
  };
  for (const double scale : kScales) {
    // place / scale is true, moves by t, and reads scale times as far: R place + scale t.
    const Pose2 longer{scale * by_odometry.x, scale * by_odometry.y, by_odometry.theta};
    if (try_out(longer, Finding::too_long)) scale_ = scale;
  }
  const bool is_fast = trail_.size() > 1 && view.stamp - std::prev(trail_.end(), 2)->stamp <= seconds(params_.fast);
  for (const double lag : kLags) {
    if (is_trail_cut_ && trail_.front().stamp > from_->stamp - seconds(lag)) break;  // not known how it moved then
    if (is_fast && try_out(now_from_then_if_late(view, lag), Finding::late)) lag_ = lag;
  }
  if (finding != Finding::nothing) return finding;
  const bool agrees = here.compared >= params_.law.least && here.share >= params_.agrees && !may_be_late;
  return agrees ? Finding::in_order : Finding::nothing;
}

void MotionCheck::lengthen_trail(const SweepView& view) {
  trail_.push_back({view.stamp, view.odom_from_sensor});
  while (view.stamp - trail_.front().stamp > seconds(kTrail)) trail_.pop_front();
}

void MotionCheck::follow(const SweepView& view) {
  lengthen_trail(view);
  last_ = Finding::in_order;
  row_ = 1;
  unproven_ = 0.0;
  const Pose2 moved = from_ ? inverse(from_->odom_from_sensor) * view.odom_from_sensor : Pose2{};
  const bool is_old = !from_ || view.stamp - from_->stamp > seconds(params_.longest);
  if (is_old || norm(moved.position()) > params_.farthest ||
      std::abs(moved.theta.radians()) > 2.0 * params_.proves_turn)
    from_ = view;
}

MotionCheck::Finding MotionCheck::add(const SweepView& view, bool may_be_late, bool do_turns_prove) {
  lengthen_trail(view);
  if (!from_) {
    from_ = view;
    return Finding::nothing;
  }
  const Pose2 moved = inverse(from_->odom_from_sensor) * view.odom_from_sensor;
  const double way = norm(moved.position());
  const double turn = std::abs(moved.theta.radians());
  Finding finding = Finding::nothing;
  const bool is_far = way >= params_.least_way || turn >= params_.least_turn;
  const Pose2 since = inverse(compared_at_) * view.odom_from_sensor;
  const bool is_other =
      norm(since.position()) >= params_.between_way || std::abs(since.theta.radians()) >= params_.between_turn;
  if (is_far && is_other && view.stamp - compared_ >= seconds(params_.between)) {
    compared_ = view.stamp;
    compared_at_ = view.odom_from_sensor;
    finding = count(compare(view, may_be_late));
    const bool is_proof = way >= params_.proves_way || (do_turns_prove && turn >= params_.proves_turn);
    if (finding == Finding::in_order && !is_proof) finding = Finding::nothing;
  }
  const bool is_pending = last_ != Finding::nothing && last_ != Finding::in_order && row_ < params_.sure;
  if (way > params_.farthest || turn > 2.0 * params_.proves_turn ||
      (view.stamp - from_->stamp > seconds(params_.longest) && !is_pending)) {
    unproven_ = finding == Finding::in_order ? 0.0 : unproven_ + way;
    from_ = view;
    if (finding == Finding::nothing && unproven_ > params_.unproven_way && !may_be_late) return Finding::untold;
  }
  return finding;
}

}  // namespace docent::collision_avoidance
