#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/range_law.h"
#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct MotionCheckParams {
  RangeLawParams law{.noise = 0.06, .per_metre = 0.012};  ///< people are left to the shares below
  double least_way = 0.12;     ///< [m] between two sweeps that are compared: twice as much differs by more than noise
  double least_turn = 0.25;    ///< [rad] or this
  double proves_way = 0.3;     ///< [m] after which a sweep that is as expected bears the scanner out
  double proves_turn = 0.35;   ///< [rad] or after this
  double farthest = 1.0;       ///< [m] then other places are in view,
  double longest = 4.0;        ///< [s] or other people
  double between = 0.09;       ///< [s] between comparisons,
  double between_way = 0.02;   ///< [m] and driven so far, or
  double between_turn = 0.03;  ///< [rad] turned: who stands learns nothing more
  double fast = 0.21;          ///< [s] between sweeps at most; slower ones do not tell that they are late
  double agrees = 0.5;         ///< of the samples as odometry has it: in order, people and all
  double surely_agrees = 0.7;  ///< likewise: nothing else need be tried
  double explains = 0.72;      ///< of the samples must follow another explanation,
  double better = 0.25;        ///< and so many more than odometry's
  int sure = 4;                ///< comparisons in succession
  double differs_way = 0.08;   ///< [m] between two explanations, else they are one
  double differs_turn = 0.06;  ///< [rad] likewise
  double late = 0.5;           ///< [s] later sweeps must look otherwise before one that was late is believed,
  double otherwise = 0.15;     ///< by so many of the samples
  double unproven_way = 1.0;   ///< [m] driven with too few samples to tell anything
};

/// Whether what a scanner sees changes as odometry says that it moves. Two sweeps, a quarter of a metre or more apart,
/// are compared under other explanations as well: ranges that are some times too long, for which each metre driven
/// brings the wall two nearer, and sweeps that are older than their stamps.
class MotionCheck {
 public:
  explicit MotionCheck(const MotionCheckParams& params = {}) : params_{params} {}

  /// `untold`: a metre was driven, and nothing could be compared
  enum class Finding { nothing, in_order, untold, too_long, late };
  /// One sweep. O(samples * explanations) where something does not fit, else O(samples). @returns what is sure
  /// @param may_be_late  the sweeps are in order only where late ones would look otherwise
  /// @param do_turns_prove  of factors, which no turn on the spot shows, something else would tell
  Finding add(const SweepView& view, bool may_be_late = false, bool do_turns_prove = true);
  /// One sweep that something else has borne out: it is followed, and not compared. O(1).
  void follow(const SweepView& view);
  [[nodiscard]] double scale() const { return scale_; }  ///< of the last `too_long`
  [[nodiscard]] double lag() const { return lag_; }      ///< [s] of the last `late`
  /// Nothing that was seen of before counts: the robot was carried off, or the scanner was seen to lie.
  void forget() {
    from_.reset();
    trail_.clear();
    is_trail_cut_ = true;
    last_ = Finding::nothing;
    row_ = 0;
  }

 private:
  void lengthen_trail(const SweepView& view);
  [[nodiscard]] Agreement share_of(const SweepView& view, const Pose2& now_from_then);
  [[nodiscard]] Finding compare(const SweepView& view, bool may_be_late);
  [[nodiscard]] Pose2 now_from_then_if_late(const SweepView& view, double lag) const;
  [[nodiscard]] bool would_late_ones_differ(const SweepView& view, const Pose2& by_odometry, double agrees);
  [[nodiscard]] bool differs(const Pose2& a, const Pose2& b) const;
  [[nodiscard]] Pose2 odom_from_sensor_at(Time time) const;
  [[nodiscard]] Finding count(Finding finding);

  MotionCheckParams params_;
  std::optional<SweepView> from_;
  struct Step {
    Time stamp;
    Pose2 odom_from_sensor;
  };
  std::deque<Step> trail_;
  bool is_trail_cut_ = false;  ///< it did not stand where the trail begins
  std::vector<float> expected_;
  Time compared_{};
  Pose2 compared_at_;  ///< odom_from_sensor
  Finding last_ = Finding::nothing;
  int row_ = 0;
  double scale_ = 1.0;
  double lag_ = 0.0;
  double unproven_ = 0.0;
};

}  // namespace docent::collision_avoidance
