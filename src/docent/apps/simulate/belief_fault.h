#pragma once

#include <optional>

#include "docent/base/time.h"
#include "docent/messages/localization_messages.h"
#include "docent/simulator/scenario/scenario.h"

namespace docent::apps::simulate_command {

/// Faults of a scenario that strike between `localize` and those who read its belief. One of each kind at a time.
class BeliefFault {
 public:
  void strike(const simulator::PoseError& event, Time now);
  void strike(const simulator::SecondMode& event, Time now);

  /// The belief as the others get it. O(cells).
  [[nodiscard]] docent_msgs::Belief apply(docent_msgs::Belief belief, Time now);

 private:
  struct Second {
    simulator::SecondMode event;
    Time until;
    std::optional<Pose2> second_from_first;  ///< rigid motion of the map, from the first belief on
  };
  void add_mode(docent_msgs::Belief& belief, Second& second) const;

  std::optional<simulator::PoseError> error_;
  Time error_until_{};
  std::optional<Second> second_;
};

}  // namespace docent::apps::simulate_command
