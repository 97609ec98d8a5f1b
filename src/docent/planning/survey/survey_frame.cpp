#include "docent/planning/survey/survey_frame.h"

#include <utility>

namespace docent::planning {

SurveyFrame::SurveyFrame(const Pose2& home, std::optional<localization::LocalizerCheckpoint> before,
                         const motion_models::BaseReach& base)
    : home_{home}, before_{std::move(before)}, unbroken_{base} {}

void SurveyFrame::move(Time stamp, const collision_avoidance::BaseState& state) {
  const auto reading = unbroken_.add(stamp, state.odom_from_base);
  if (reading.is_late && !odometry_.empty()) return;
  if (reading.is_set_back) odometry_.forget();
  // A base that derives its velocity from its pose says nonsense in a jump.
  const bool keeps = reading.jumped && !odometry_.empty();
  odometry_.add(stamp, {reading.odom_from_base, keeps ? odometry_.newest().velocity : state.velocity});
  odom_from_base_ = odometry_.newest().odom_from_base;
}

Pose2 SurveyFrame::raw_from_odom() const {
  return odometry_.empty() ? Pose2{} : raw_from_odom(odometry_.newest_stamp());
}

Pose2 SurveyFrame::start_of(const Pose2& odom_from_base) const {
  if (!before_ ||
      distance(before_->odom_from_robot.position(), odom_from_base.position()) > localization::kCheckpointWay)
    return home_ * inverse(odom_from_base);
  return before_->modes.front().map_from_robot * inverse(before_->odom_from_robot);
}

Pose2 SurveyFrame::begin_moment(const Pose2& odom_from_base) {
  if (!start_from_odom_) start_from_odom_ = start_of(odom_from_base);
  if (last_) way_ += distance(last_->position(), odom_from_base.position());
  last_ = odom_from_base;
  return *start_from_odom_ * odom_from_base;
}

void SurveyFrame::lie(const Pose2& after_from_before) {
  if (map_from_odom_) map_from_odom_ = after_from_before * *map_from_odom_;
}

void SurveyFrame::begin_anew(const Pose2& site_from_survey) {
  constexpr double kShortWay = 15.0;  // [m]: so far odometry is better than a map that was drawn wrongly
  if (way_ > kShortWay && map_from_odom_) start_from_odom_ = inverse(site_from_survey) * *map_from_odom_;
  if (start_from_odom_) map_from_odom_ = site_from_survey * *start_from_odom_;
}

void SurveyFrame::end_moment(const Pose2& map_from_base) { map_from_odom_ = map_from_base * inverse(*last_); }

std::optional<Pose2> SurveyFrame::map_from_base() const {
  if (!map_from_odom_ || !odom_from_base_) return std::nullopt;
  return *map_from_odom_ * *odom_from_base_;
}

}  // namespace docent::planning
