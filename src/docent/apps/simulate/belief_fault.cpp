#include "docent/apps/simulate/belief_fault.h"

#include <algorithm>
#include <limits>

namespace docent::apps::simulate_command {

namespace {

constexpr std::size_t kMostCells = 8192;  // architecture 10.5

Time end_of(double duration, Time now) {
  return duration > 0.0 ? now + seconds(duration) : Time{std::numeric_limits<std::int64_t>::max()};
}

}  // namespace

void BeliefFault::strike(const simulator::PoseError& event, Time now) {
  error_ = event;
  error_until_ = end_of(event.duration, now);
}

void BeliefFault::strike(const simulator::SecondMode& event, Time now) {
  second_ = Second{event, end_of(event.duration, now), std::nullopt};
}

void BeliefFault::add_mode(docent_msgs::Belief& belief, Second& second) const {
  const auto& best = belief.hypotheses.front();
  const Pose2 first{best.x, best.y, Angle::radians(best.theta)};
  if (!second.second_from_first) second.second_from_first = second.event.at * inverse(first);
  const auto moved = [&](double x, double y, double theta) {
    return *second.second_from_first * Pose2{x, y, Angle::radians(theta)};
  };
  std::stable_sort(belief.cells.begin(), belief.cells.end(),
                   [](const auto& a, const auto& b) { return a.mass > b.mass; });
  if (belief.cells.size() > kMostCells / 2) belief.cells.resize(kMostCells / 2);
  for (std::size_t i = 0, count = belief.cells.size(); i < count; ++i) {
    auto& cell = belief.cells[i];
    cell.mass *= 0.5F;
    const Pose2 pose = moved(cell.x, cell.y, cell.theta);
    belief.cells.push_back({static_cast<float>(pose.x), static_cast<float>(pose.y),
                            static_cast<float>(pose.theta.radians()), belief.cells[i].mass});
  }
  auto& hypotheses = belief.hypotheses;
  hypotheses.front().mass *= 0.5;
  auto other = hypotheses.front();
  const Pose2 pose = moved(other.x, other.y, other.theta);
  other.x = pose.x;
  other.y = pose.y;
  other.theta = pose.theta.radians();
  hypotheses.insert(hypotheses.begin() + 1, other);
}

docent_msgs::Belief BeliefFault::apply(docent_msgs::Belief belief, Time now) {
  if (belief.hypotheses.empty()) return belief;
  if (second_ && now < second_->until) add_mode(belief, *second_);
  if (error_ && now < error_until_) {
    auto& best = belief.hypotheses.front();
    best.x += error_->x;
    best.y += error_->y;
    best.theta += error_->heading;
  }
  return belief;
}

}  // namespace docent::apps::simulate_command
