#pragma once

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/judgement/verdict.h"
#include "docent/messages/docent_messages.h"
#include "docent/messages/standard_messages.h"

namespace docent::modules {

inline constexpr Duration kSilent = std::chrono::milliseconds{1500};  // a topic of a sensor that should have spoken

/// What the belief holds beside its listed cells.
[[nodiscard]] docent_msgs::CoarseBelief rest_message(const localization::BeliefSummary& summary);

/// Cells, modes and rest of a belief, in the frame `map`. O(cells).
[[nodiscard]] docent_msgs::Belief belief_message(const localization::BeliefSummary& summary, Time stamp);
/// How likely the robot is lost, and why.
void add_verdict(docent_msgs::Belief& message, const localization::Verdict& verdict);

/// The frame `odom` in the frame `map`, as TF has it.
[[nodiscard]] tf2_msgs::TFMessage odom_in_map_message(const Pose2& map_from_odom, Time stamp);

/// The pose and covariance of a mode, in the frame `map`. O(1).
[[nodiscard]] geometry_msgs::PoseWithCovarianceStamped pose_message(const localization::BeliefMode& mode, Time stamp);

}  // namespace docent::modules
