#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/range_law.h"
#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct OldSweepsParams {
  RangeLawParams law{.noise = 0.06, .per_metre = 0.012};
  double least_lag = 0.4;     ///< [s] less is a delay, which `calibrate` makes up for
  double most_lag = 3.0;      ///< [s]
  double lag_step = 0.1;      ///< [s]
  double window = 4.0;        ///< [s] of looks that count
  double between = 0.09;      ///< [s] between looks
  double longest = 2.0;       ///< [s] from the reference to a look: then people have moved
  double farthest = 0.5;      ///< [m] likewise: then other things are in view
  double widest = 0.6;        ///< [rad] likewise
  double fits = 0.65;         ///< of the samples fit the motion that is measured; fewer: it is not known
  double surely_fits = 0.8;   ///< of the samples fit: nothing better need be looked for
  double than_wheels = 0.1;   ///< of the samples more must fit a motion that is not odometry's
  double step_turn = 0.0175;  ///< [rad] of the search: a sample of a degree
  double step_way = 0.04;     ///< [m] likewise
  int steps = 10;             ///< of it
  double turned = 0.1;        ///< [rad] by odometry in the last seconds; less tells nothing
  std::size_t looks = 8;      ///< and more, of which
  double least_turn = 0.15;   ///< [rad] the scanner saw such a turn,
  double exact = 0.02;        ///< [rad] so exactly that which odometry had some time ago,
  double otherwise = 0.03;    ///< [rad] and not what it has now, nor what a slip of the wheels makes of that:
  double better = 3.5;        ///< times as inexact
  double newest = 1.0;        ///< [s] of the looks that odometry of now must not explain
  double same_lag = 0.15;     ///< [s]
  int sure = 2;               ///< looks in succession that say the same
  double stops = 0.12;        ///< [rad] that old sweeps turn on when the robot stops
};

/// Finds sweeps that are older than their stamps, from the first one on. While the robot turns, the turn that a scanner
/// sees is measured by its sweeps alone, each against one of a moment ago. Of old sweeps it is what odometry had some
/// time before, in every look of some seconds. Wheels that slip make a turn that no sweep ever sees, or miss one that
/// odometry never had; a base that turns less than it says turns less all the time: a least-squares mixture of a steady
/// turn and of a share of odometry's, which explains those, must not explain what was seen.
class OldSweeps {
 public:
  explicit OldSweeps(const OldSweepsParams& params = {}) : params_{params} {}

  /// One sweep. O(samples) where sweeps fit odometry, else O(samples * steps). @param base_from_sensor  its mount
  /// @returns [s] how old the sweeps of the last seconds are
  std::optional<double> add(const SweepView& view, const Pose2& base_from_sensor);
  /// After it was said: the robot has stopped, and so have the sweeps. A hand held it, or the wheels slipped.
  [[nodiscard]] bool is_refuted() const { return is_refuted_; }
  /// Odometry has jumped.
  void forget();

 private:
  /// Of the base, seen from where the reference was taken.
  struct Motion {
    double way = 0.0;   ///< [m] ahead
    double turn = 0.0;  ///< [rad]
  };
  struct Fit {
    Motion motion;
    double share = -1.0;  ///< of the samples
  };
  struct Step {
    Time stamp;
    double heading = 0.0;  ///< [rad] by odometry, without wrapping
    Pose2 odom_from_sensor;
  };
  struct Look {
    Time from;
    Time stamp;
    double turn = 0.0;  ///< [rad] that the sweeps saw
  };
  void follow(const SweepView& view);
  [[nodiscard]] bool has_turned() const;
  [[nodiscard]] Fit fit_of(const SweepView& view, const Motion& motion, const Pose2& base_from_sensor);
  [[nodiscard]] Fit best_near(const SweepView& view, Fit best, const Pose2& base_from_sensor);
  [[nodiscard]] std::optional<Motion> measure(const SweepView& view, const Pose2& base_from_sensor);
  void refer_to(const SweepView& view);
  [[nodiscard]] double heading_at(Time time) const;
  /// [rad] Root mean square of what odometry of `lag` [s] ago leaves of the turns that were seen. @param since  looks
  /// @param most  [rad] more need not be told exactly: infinity
  [[nodiscard]] double left_by(double lag, Time since = {},
                               double most = std::numeric_limits<double>::infinity()) const;
  /// [rad] Likewise, of the best mixture of a steady turn and a share of odometry's.
  [[nodiscard]] double left_by_slip() const;
  [[nodiscard]] std::optional<double> lag() const;
  void judge(const SweepView& view);

  OldSweepsParams params_;
  std::optional<SweepView> reference_;
  Motion last_;    ///< the last look's
  Motion before_;  ///< and that of the one before
  Time looked_{};
  std::deque<Step> trail_;
  bool is_trail_cut_ = false;  ///< it did not stand where the trail begins
  std::deque<Look> looks_;
  std::vector<float> expected_;
  double lag_ = 0.0;
  int row_ = 0;
  Time said_{};  ///< when old sweeps were said, and not yet refuted or borne out
  bool is_refuted_ = false;
};

}  // namespace docent::collision_avoidance
