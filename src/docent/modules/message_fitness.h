#pragma once

#include "docent/messages/topics.h"

namespace docent {

/// Whether all numbers of a message are numbers. What is none has no place in any comparison, so a message that is not
/// fit counts as none, and its silence is noticed. The readings themselves may be NaN where that says "no reading".
[[nodiscard]] bool is_fit(const nav_msgs::Odometry& odometry);
/// A sweep of a sensor: where its beams point and how far they reach.
[[nodiscard]] bool is_fit(const sensor_msgs::LaserScan& scan);
/// Virtual measurements, moreover: a number in every direction all round.
[[nodiscard]] bool is_fit_all_round(const sensor_msgs::LaserScan& scan);
[[nodiscard]] bool is_fit(const sensor_msgs::Range& range);
[[nodiscard]] bool is_fit(const docent_msgs::ObstacleLines& seen);
[[nodiscard]] bool is_fit(const docent_msgs::PersonBeams& beams);
[[nodiscard]] bool is_fit(const docent_msgs::Belief& belief);
[[nodiscard]] bool is_fit(const docent_msgs::Target& target);
[[nodiscard]] bool is_fit(const docent_msgs::Limits& limits);

}  // namespace docent
