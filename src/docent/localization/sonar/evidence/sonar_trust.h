#pragma once

#include <cstddef>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/localization/judgement/verdict.h"

namespace docent::localization {

/// Whether a ring of sonars may be believed. One that hears the same again and again though the robot moves has died
/// with its last reading on the line; one that hears nothing of what the belief lets expect is deaf. Too short readings
/// tell nothing: they may be people as well as a sensor's fault, and a filter takes out both.
class SonarTrust {
 public:
  enum class State { well, frozen, at_odds };

  explicit SonarTrust(int sonars) : ring_(static_cast<std::size_t>(sonars)) {}

  /// An echo; `odom_from_robot` when it was heard. That nothing was heard, again and again, tells nothing here.
  /// @pre 0 <= sonar < sonars
  void hear(int sonar, double range, const Pose2& odom_from_robot);
  void hear_nothing(int sonar) { ring_[static_cast<std::size_t>(sonar)] = {}; }
  /// Readings of one update against the belief. Readings without an echo count as longer where it lets expect one.
  void compare(const Agreement& readings);

  [[nodiscard]] State state() const;
  /// Share of the readings that are not too short, running mean.
  [[nodiscard]] double agreement() const { return agreement_; }

 private:
  struct Ear {
    double range = -1.0;    ///< [m]; negative: nothing
    Pose2 odom_from_robot;  ///< when it began to hear this range
    bool is_stuck = false;
  };
  std::vector<Ear> ring_;
  double agreement_ = 0.5;
  bool at_odds_ = false;
};

}  // namespace docent::localization
