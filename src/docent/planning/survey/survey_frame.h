#pragma once

#include <optional>

#include "docent/base/time.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/geometry/pose2.h"
#include "docent/localization/belief/checkpoint.h"
#include "docent/motion_models/unbroken_odometry.h"

namespace docent::planning {

/// Where the robot is in the frame of the map that it is making. The frame is that of its home, from where it sets out;
/// or that of the survey that it was at before it began anew. A jump of the odometry is no way: `odom` is the odometry
/// without them here, `raw` its own frame.
class SurveyFrame {
 public:
  /// @param before  where it was a moment ago, before it began anew; none: it stands at home
  /// @param base  what it can do: more is a jump
  explicit SurveyFrame(const Pose2& home, std::optional<localization::LocalizerCheckpoint> before = std::nullopt,
                       const motion_models::BaseReach& base = {});

  /// Odometry, as it comes, in its own frame.
  void move(Time stamp, const collision_avoidance::BaseState& state);
  /// A moment that the map gets. @returns the pose by odometry alone, from where the robot began [m], survey
  Pose2 begin_moment(const Pose2& odom_from_base);
  /// The map begins anew, from where odometry has the robot: what is seen now contradicts what was drawn.
  /// @param site_from_survey  where the survey lies
  void begin_anew(const Pose2& site_from_survey);
  /// All of the map lies elsewhere.
  void lie(const Pose2& after_from_before);
  /// Where the map found the robot to be at that moment.
  void end_moment(const Pose2& map_from_base);

  [[nodiscard]] const collision_avoidance::BaseHistory& odometry() const { return odometry_; }
  [[nodiscard]] std::optional<Pose2> odom_from_base() const { return odom_from_base_; }  ///< now; none: not heard yet
  [[nodiscard]] std::optional<Pose2> map_from_odom() const { return map_from_odom_; }    ///< none before any moment
  [[nodiscard]] std::optional<Pose2> map_from_base() const;                              ///< now
  /// As the odometry was torn at `stamp`.
  [[nodiscard]] Pose2 raw_from_odom(Time stamp) const { return inverse(unbroken_.odom_from_raw(stamp)); }
  [[nodiscard]] Pose2 raw_from_odom() const;         ///< now
  [[nodiscard]] double way() const { return way_; }  ///< [m] from moment to moment

 private:
  [[nodiscard]] Pose2 start_of(const Pose2& odom_from_base) const;

  Pose2 home_;
  std::optional<localization::LocalizerCheckpoint> before_;
  motion_models::UnbrokenOdometry unbroken_;
  collision_avoidance::BaseHistory odometry_;
  std::optional<Pose2> odom_from_base_;
  std::optional<Pose2> start_from_odom_;
  std::optional<Pose2> map_from_odom_;
  std::optional<Pose2> last_;  ///< odom_from_base of the last moment
  double way_ = 0.0;
};

}  // namespace docent::planning
