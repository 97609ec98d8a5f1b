#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/truth_messages.h"

namespace docent::evaluation {

/// The last seconds of ground truth, so that what the robot said of a moment can be held against that moment.
class TruthHistory {
 public:
  void add(std::shared_ptr<const docent_msgs::TrueState> state);

  [[nodiscard]] bool empty() const { return states_.empty(); }
  [[nodiscard]] const docent_msgs::TrueState& latest() const { return *states_.back().state; }
  [[nodiscard]] Time latest_time() const { return states_.back().time; }
  /// Interpolated; nullopt for a time before what is kept or after the latest.
  [[nodiscard]] std::optional<Pose2> pose_at(Time time) const;
  /// The state nearest in time, at most 0.15 s away.
  [[nodiscard]] const docent_msgs::TrueState* state_at(Time time) const;

 private:
  struct Entry {
    Time time;
    std::shared_ptr<const docent_msgs::TrueState> state;
  };
  std::deque<Entry> states_;
};

[[nodiscard]] Pose2 true_pose(const docent_msgs::TrueState& state);

}  // namespace docent::evaluation
