#pragma once

#include <map>
#include <optional>
#include <string>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/truth_messages.h"

namespace docent::evaluation {

/// How a robot crossed a crowd, by the truth, after the definitions of HuNavSim's evaluator (hunav_metrics.py) where it
/// has one. The distance to a person is there the one from the robot's outline to the person's middle: intimate below
/// 0.45 m, personal below 1.2 m, social below 3.6 m; each instant counts once, for the nearest person.
struct SocialReport {
  bool arrived = false;  ///< in time; "completed" there
  double seconds = 0.0;  ///< until it arrived or the time was over
  double path_m = 0.0;
  double heading_changes = 0.0;  ///< [rad] cumulative
  double not_moving_s = 0.0;     ///< below 0.001 m/s and 0.01 rad/s
  double intimate_s = 0.0;
  double personal_s = 0.0;
  double social_s = 0.0;
  double mean_closest_m = 0.0;  ///< between the outlines, mean over time
  double least_m = 0.0;         ///< the same, least
  /// Intimate towards anybody while the robot's own velocity closes that gap, by more than 0.02 m/s: who comes near a
  /// robot that waits, or walks past behind it, does not count.
  double intimate_closing_s = 0.0;
  /// The same with 0.45 m between the outlines.
  double near_closing_s = 0.0;
  std::map<std::string, int> contacts;  ///< that count (architecture 9), by kind
  int bumped_by_people = 0;
  double density_met = 0.0;     ///< [1/m2] persons within 2 m of the robot, mean over time
  double density_passed = 0.0;  ///< [1/m2] the same, mean over the way driven
};

/// Collects the truth of one trial.
class SocialScore {
 public:
  /// @param goal  [m], world; reached within `goal_radius`
  /// @param limit  [s] since `start`
  SocialScore(Time start, Point2 goal, double goal_radius, double limit, double robot_radius)
      : start_{start}, goal_{goal}, goal_radius_{goal_radius}, limit_{limit}, robot_radius_{robot_radius} {}

  /// Ten times a second. Once the trial is over nothing counts any more.
  void add(const docent_msgs::TrueState& state);
  void add(const docent_msgs::TrueContact& contact);
  [[nodiscard]] bool is_over() const { return is_over_; }
  [[nodiscard]] SocialReport report() const;

 private:
  void judge_people(const docent_msgs::TrueState& state, double dt, double way);

  Time start_;
  Point2 goal_;
  double goal_radius_;
  double limit_;
  double robot_radius_;
  std::optional<docent_msgs::TrueState> last_;
  SocialReport report_;
  bool is_over_ = false;
  double closest_sum_ = 0.0;
  double density_sum_ = 0.0;
  double density_way_sum_ = 0.0;
};

[[nodiscard]] std::string to_json(const SocialReport& report);

}  // namespace docent::evaluation
