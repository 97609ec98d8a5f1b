#pragma once

#include <deque>

#include "docent/evaluation/deployment_report.h"
#include "docent/evaluation/truth_history.h"
#include "docent/messages/people_messages.h"
#include "docent/messages/truth_messages.h"

namespace docent::evaluation {

/// Holds tracked people against the true ones, within 5 m of the robot, by the rules of people_match.h.
class PeopleScore {
 public:
  /// Tracks are in the map's frame: only while the robot says that it is localized does it claim any, right or wrong.
  void add(const docent_msgs::People& people);
  /// After every new true state.
  void step(const TruthHistory& truth);
  [[nodiscard]] const DeploymentReport::People& result() const { return result_; }

 private:
  void judge(const docent_msgs::People& people, const docent_msgs::TrueState& truth);
  std::deque<docent_msgs::People> waiting_;
  DeploymentReport::People result_;
};

}  // namespace docent::evaluation
