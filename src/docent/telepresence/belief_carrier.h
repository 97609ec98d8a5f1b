#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/localization_messages.h"

namespace docent::telepresence {

/// A place where the robot may be, now.
struct CarriedHypothesis {
  Pose2 map_from_base;
  double mass = 0.0;
};

/// Carries the belief's hypotheses forward with odometry, so that what is shown moves between two beliefs.
class BeliefCarrier {
 public:
  void add_odometry(const nav_msgs::Odometry& odometry);
  void set_belief(const docent_msgs::Belief& belief);

  /// Best pose at `time`; nullopt while not localized or without odometry.
  [[nodiscard]] std::optional<Pose2> map_from_base(Time time) const;
  /// All hypotheses with at least `min_mass`, best first.
  [[nodiscard]] std::vector<CarriedHypothesis> hypotheses(Time time, double min_mass) const;
  [[nodiscard]] bool is_localized() const { return is_localized_; }
  [[nodiscard]] double p_lost() const { return p_lost_; }
  [[nodiscard]] double linear() const { return linear_; }    ///< [m/s]
  [[nodiscard]] double angular() const { return angular_; }  ///< [rad/s]

 private:
  struct Sample {
    Time time;
    Pose2 odom_from_base;
  };
  /// Between the two samples around `time`; the nearest one outside.
  [[nodiscard]] std::optional<Pose2> odom_from_base(Time time) const;

  std::deque<Sample> samples_;  ///< the last seconds, by time
  std::vector<CarriedHypothesis> hypotheses_;
  Pose2 belief_odom_from_base_;
  bool is_localized_ = false;
  double p_lost_ = 1.0;
  double linear_ = 0.0;
  double angular_ = 0.0;
};

}  // namespace docent::telepresence
