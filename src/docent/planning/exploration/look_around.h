#pragma once

#include <functional>
#include <optional>
#include <span>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::planning {

struct LookAroundStep {
  bool drive = false;       ///< else turn
  Point2 via{};             ///< [m], odom: where to drive
  Angle heading{};          ///< odom: where to turn
  double tolerance = 0.25;  ///< [m] from `via`: there
};

/// Moves a robot that does not know where it is (architecture 8.4): to where its hypotheses are told apart, where it
/// has such; else a full turn on the spot, then a short drive into the widest direction that its sensors and the
/// virtual measurements of its whole belief leave free, then another turn. Where nothing is free for a metre and more,
/// as in narrow corridors and amid people, it makes do with some decimetres, and rather not back to where it came from:
/// another view tells more than another turn. A drive on which it is held up for long, as amid people, is given up for
/// another turn: what opens meanwhile lies elsewhere.
class LookAround {
 public:
  /// Starts over.
  void start(Time now);
  /// @param odom_from_base  where the robot is, odometry
  /// @param clearances  [180] free distance [m] round the robot, every 2 degrees from -180, base frame: the smaller of
  /// real and virtual measurements; empty: not known, only turning is safe
  /// @param telling  base frame [m]: a free place from which the hypotheses can be told apart, if there is one; asked
  /// for only where a drive may begin
  [[nodiscard]] LookAroundStep step(const Pose2& odom_from_base, std::span<const double> clearances,
                                    const std::function<std::optional<Point2>()>& telling, Time now);
  /// [s] since its drive last came nearer to its end; while it turns, since it would have driven and nothing was free.
  [[nodiscard]] double held_up_s(Time now) const;
  /// Nothing was free when it would have driven last.
  [[nodiscard]] bool is_hemmed_in() const { return hemmed_in_since_.has_value(); }

 private:
  [[nodiscard]] LookAroundStep drive_to(const Pose2& odom_from_base, Point2 in_base, Time now);
  [[nodiscard]] LookAroundStep drive_on() const { return {true, *aim_, {}, tolerance_}; }
  /// Where to drive now, base frame; nullopt: nothing is free.
  [[nodiscard]] std::optional<Point2> free_place(const Pose2& odom_from_base, std::span<const double> clearances) const;
  void turn_anew(Time now);
  [[nodiscard]] LookAroundStep turn_on(const Pose2& odom_from_base);

  enum class Phase { turning, driving } phase_ = Phase::turning;
  double turned_ = 0.0;  ///< [rad] in this turn
  std::optional<Angle> last_heading_;
  std::optional<Point2> aim_;
  double tolerance_ = 0.25;     ///< [m] from the aim
  std::optional<Point2> left_;  ///< [m], odom: where its last drive began
  std::optional<Time> hemmed_in_since_;
  double nearest_ = 0.0;  ///< [m] that it came to the aim, and
  Time nearer_since_{};   ///< when
  Time phase_start_{};
  std::optional<Time> asked_;  ///< when `telling` was asked last
};

}  // namespace docent::planning
