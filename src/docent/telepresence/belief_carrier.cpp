#include "docent/telepresence/belief_carrier.h"

#include <algorithm>

#include "docent/messages/conversions.h"

namespace docent::telepresence {
namespace {
constexpr Duration kKept = std::chrono::seconds{3};
}

void BeliefCarrier::add_odometry(const nav_msgs::Odometry& odometry) {
  const Time time = from_message(odometry.header.stamp);
  if (!samples_.empty() && time <= samples_.back().time) {
    if (samples_.back().time - time < kKept) return;
    samples_.clear();  // the driver began anew
  }
  samples_.push_back({time, from_message(odometry.pose.pose)});
  while (time - samples_.front().time > kKept) samples_.pop_front();
  linear_ = odometry.twist.twist.linear.x;
  angular_ = odometry.twist.twist.angular.z;
}

void BeliefCarrier::set_belief(const docent_msgs::Belief& belief) {
  hypotheses_.clear();
  for (const auto& hypothesis : belief.hypotheses) {
    hypotheses_.push_back({{hypothesis.x, hypothesis.y, Angle::radians(hypothesis.theta)}, hypothesis.mass});
  }
  belief_odom_from_base_ = from_message(belief.odom_pose);
  is_localized_ = belief.localized;
  p_lost_ = belief.p_lost;
}

std::optional<Pose2> BeliefCarrier::odom_from_base(Time time) const {
  if (samples_.empty()) return std::nullopt;
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), time,
                                      [](const Sample& sample, Time value) { return sample.time < value; });
  if (after == samples_.end()) return samples_.back().odom_from_base;
  if (after == samples_.begin()) return after->odom_from_base;
  const auto before = std::prev(after);
  const double part = to_seconds(time - before->time) / to_seconds(after->time - before->time);
  const Pose2& a = before->odom_from_base;
  const Pose2& b = after->odom_from_base;
  return Pose2{a.x + part * (b.x - a.x), a.y + part * (b.y - a.y),
               a.theta + Angle::radians(part * (b.theta - a.theta).radians())};
}

std::optional<Pose2> BeliefCarrier::map_from_base(Time time) const {
  const auto now = odom_from_base(time);
  if (!is_localized_ || hypotheses_.empty() || !now) return std::nullopt;
  return hypotheses_.front().map_from_base * (inverse(belief_odom_from_base_) * *now);
}

std::vector<CarriedHypothesis> BeliefCarrier::hypotheses(Time time, double min_mass) const {
  std::vector<CarriedHypothesis> carried;
  const auto now = odom_from_base(time);
  const Pose2 moved = now ? inverse(belief_odom_from_base_) * *now : Pose2{};
  for (const auto& hypothesis : hypotheses_) {
    if (hypothesis.mass >= min_mass) carried.push_back({hypothesis.map_from_base * moved, hypothesis.mass});
  }
  return carried;
}

}  // namespace docent::telepresence
