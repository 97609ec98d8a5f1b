#pragma once

#include <deque>

#include "docent/evaluation/deployment_report.h"
#include "docent/evaluation/truth_history.h"
#include "docent/messages/docent_messages.h"

namespace docent {

/// Holds tracked people against the true ones, within 5 m of the robot, by the rules of people_match.h.
class PeopleScore {
 public:
  /// @param is_localized  tracks are in the map's frame: while the robot is lost they cannot be judged.
  void add(const docent_msgs::People& people, bool is_localized);
  /// After every new true state.
  void step(const TruthHistory& truth);
  [[nodiscard]] const DeploymentReport::People& result() const { return result_; }

 private:
  void judge(const docent_msgs::People& people, const docent_msgs::TrueState& truth);
  std::deque<docent_msgs::People> waiting_;
  DeploymentReport::People result_;
};

}  // namespace docent
