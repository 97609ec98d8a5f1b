#include "docent/evaluation/localization_score.h"

#include <algorithm>
#include <cmath>

#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

constexpr double kRightDistance = 0.5;  ///< [m]
constexpr double kRightHeading = 20.0;  ///< [deg]
constexpr double kStays = 10.0;         ///< [s] right without a break: localized
constexpr double kLostAfter = 1.0;      ///< [s] not right: a lost event begins
constexpr double kFoundAfter = 2.0;     ///< [s] right again: it ends
constexpr double kStale = 3.0;          ///< [s] a belief is good for so long …
constexpr double kStaleDistance = 1.0;  ///< … or for so many metres
constexpr std::size_t kMostClaims = 1000;

}  // namespace

void LocalizationScore::add_belief(const docent_msgs::Belief& belief) {
  Claim claim;
  claim.stamp = from_message(belief.header.stamp);
  claim.localized = belief.localized && !belief.hypotheses.empty();
  if (claim.localized) {
    const auto& best = belief.hypotheses.front();
    claim.map_from_base = {best.x, best.y, Angle::radians(best.theta)};
  }
  waiting_.push_back(claim);
  if (waiting_.size() > kMostClaims) waiting_.pop_front();
}

void LocalizationScore::step(const TruthHistory& truth) {
  const Time now = truth.latest_time();
  if (!has_started_) {
    has_started_ = true;
    start_ = last_ = right_since_ = wrong_since_ = now;
  }
  while (!waiting_.empty() && waiting_.front().stamp <= now) {
    const Claim claim = waiting_.front();
    waiting_.pop_front();
    const auto pose = truth.pose_at(claim.stamp);
    // A belief of a moment before the truth began cannot be judged.
    if (!pose || claim.stamp < claim_time_) continue;
    claim_time_ = claim.stamp;
    distance_at_claim_ = truth.latest().distance_m;
    judge(claim, *pose);
  }
  result_.blocked_beam_fraction.add(truth.latest().blocked_beams);
  tick(now, to_seconds(now - last_), truth.latest().distance_m);
  last_ = now;
}

void LocalizationScore::judge(const Claim& claim, const Pose2& truth) {
  claimed_localized_ = claim.localized;
  claim_is_right_ = false;
  if (!claim.localized) return;
  const double error = distance(claim.map_from_base.position(), truth.position());
  const double heading = std::abs((claim.map_from_base.theta - truth.theta).degrees());
  result_.error_m.add(error);
  result_.heading_error_deg.add(heading);
  errors_m_.add(error);
  claim_is_right_ = error <= kRightDistance && heading <= kRightHeading;
}

void LocalizationScore::tick(Time now, double dt, double distance_m) {
  const bool is_fresh = to_seconds(now - claim_time_) <= kStale || distance_m - distance_at_claim_ <= kStaleDistance;
  const bool was_right = is_right_;
  is_right_ = claim_is_right_ && is_fresh;
  if (is_right_ && !was_right) right_since_ = now;
  if (!is_right_ && was_right) wrong_since_ = now;
  if (!result_.localized_after_s) {
    if (is_right_ && to_seconds(now - right_since_) >= kStays)
      result_.localized_after_s = to_seconds(right_since_ - start_);
    else if (!is_right_ && claimed_localized_)
      result_.wrong_but_sure_s += dt;
    return;
  }
  if (is_right_) {
    if (in_lost_event_ && to_seconds(now - right_since_) >= kFoundAfter) in_lost_event_ = false;
    return;
  }
  result_.lost_s += dt;
  if (claimed_localized_) result_.wrong_but_sure_s += dt;
  if (!in_lost_event_ && to_seconds(now - wrong_since_) >= kLostAfter) {
    in_lost_event_ = true;
    ++result_.lost_events;
  }
}

DeploymentReport::Localization LocalizationScore::result() const {
  DeploymentReport::Localization result = result_;
  result.p95_error_m = errors_m_.at(0.95);
  return result;
}

}  // namespace docent::evaluation
