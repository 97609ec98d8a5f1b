#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "docent/evaluation/command_latency.h"
#include "docent/evaluation/deployment_report.h"
#include "docent/evaluation/localization_score.h"
#include "docent/evaluation/message_ages.h"
#include "docent/evaluation/people_score.h"
#include "docent/evaluation/request_tally.h"
#include "docent/evaluation/truth_history.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// Whether a touch is a contact (architecture 9): walls, furniture and hazards always; a person if the robot's own
/// speed towards them exceeds 0.1 m/s, unless it had begun to brake fully in time and they were the faster of the two.
[[nodiscard]] bool is_contact(const docent_msgs::TrueContact& touch);

/// Accumulates the deployment report (architecture 9) from messages in the order of their times: the same code sees a
/// run while it happens and its recording, so both give the same numbers. The truth decides wherever it knows.
class DeploymentEvaluator {
 public:
  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);

  /// So far. O(beliefs) for the percentile.
  [[nodiscard]] DeploymentReport report() const;
  /// nullopt in virtual time.
  [[nodiscard]] std::optional<DeploymentReport::Latency> latency() const;
  /// False: no ground truth was in it, and the report is empty.
  [[nodiscard]] bool has_truth() const { return !truth_.empty(); }

 private:
  void add_state(std::shared_ptr<const docent_msgs::TrueState> state);
  void add_contact(const docent_msgs::TrueContact& contact);
  void add_goal_state(const docent_msgs::GoalState& goal);
  void follow_trip(const docent_msgs::GoalState& goal);
  void add_health(const docent_msgs::Health& health);
  void count_passes(const docent_msgs::TrueState& state);
  void count_battery(double level);
  [[nodiscard]] std::optional<Point2> true_place() const;

  DeploymentReport report_;
  CommandLatency latency_;
  MessageAges ages_;
  TruthHistory truth_;
  LocalizationScore localization_;
  PeopleScore people_;
  RequestTally requests_;

  Time start_{};
  double first_distance_m_ = 0.0;
  double first_contact_seconds_ = 0.0;
  bool is_relocalizing_ = false;  ///< the goal is to find itself, not to go somewhere
  bool goal_is_active_ = false;
  struct Trip {
    std::string goal;
    Time begin{};
    double distance_m = 0.0;  ///< of the odometer then
  };
  std::optional<Trip> trip_;  ///< under way
  bool is_blocked_ = false;
  bool was_inside_ = true;
  std::map<std::uint32_t, bool> is_passing_;  ///< persons near by: closer than 1 m while the robot moved
  double battery_low_ = 2.0;                  ///< since the last charge
  bool is_charging_ = false;
  bool is_depleted_ = false;
  std::map<std::string, std::int32_t> pids_;
  int restarts_seen_ = 0;
  int restarts_ordered_ = 0;
};

}  // namespace docent::evaluation
