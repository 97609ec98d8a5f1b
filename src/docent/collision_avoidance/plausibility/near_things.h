#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"
#include "docent/collision_avoidance/plausibility/sweep_form.h"

namespace docent::collision_avoidance {

struct NearThingsParams {
  double comes = 0.1;      ///< [m] beyond min_range: what was so near may be nearer in the next sweep
  double fast = 0.3;       ///< [s] between two sweeps at most: else whoever was near may have left
  double step = 1.6;       ///< [m/s] with which somebody may come nearer
  double goes = 0.15;      ///< [m] beyond min_range: what was nearer and went away must have been seen again
  double beside = 0.03;    ///< [rad] to each side, of the beams that would meet it
  double same = 0.05;      ///< [m] such places are one
  int sure = 2;            ///< sweeps until it is dropped
  int named = 4;           ///< sweeps until it is named: who steps aside before nothing is soon seen again
  int heard = 2;           ///< echoes of what the scanner leaves out, and so many sweeps
  double seen_for = 1.5;   ///< [s] after the scanner saw it,
  double seen_at = 0.25;   ///< [m] so near to there, it is what is heard
  int several = 3;         ///< places that have gone at once
  double longest = 30.0;   ///< [s] a place is held
  double within = 1.2;     ///< [m] a scanner may be blind, whatever min_range it states
  double alike = 0.12;     ///< [m] between the two readings beside it, and from one sweep to the next
  double flank = 0.05;     ///< [m] beyond the readings beside it a gap's thing was before
  double gap_known = 0.6;  ///< of a gap's samples were that near
  double proves = 30.0;    ///< [s] for which a reading proves that the scanner sees as near as that: between people's
                           ///< legs gaps come and go
};

/// Things that came up to a scanner's min_range and of which it then said that nothing is there: they are, until beams
/// end beyond the place, or the robot is so far from it that it would be seen. A scanner that is blind farther than it
/// states shows that by a gap in the middle of a thing, with readings of the thing on both sides. Odometry's frame.
class NearThings {
 public:
  explicit NearThings(const NearThingsParams& params = {}) : params_{params} {}

  /// @param before  the sweep before @param expected  [samples] [m] of it, NaN: nothing
  /// @param form  of this sweep, with the gaps that need no sweep before
  void add(const SweepView& before, const SweepView& view, std::span<const float> expected, const SweepForm& form);
  /// What sonars and infrared sensors hear, and the scanner says that nothing is there: it counts where the scanner may
  /// be blind as it states, or saw something there a moment ago. To be called after `add`.
  /// @param heard  [m] in the scanner's frame @param may_be_blind  something outside the body can be too near
  void hear(const SweepView& view, std::span<const Point2> heard, bool may_be_blind);
  /// [m] What is nearer the scanner does not see; 0: as far as is known, as it states.
  [[nodiscard]] double blind_within() const { return blind_within_; }
  /// Beams of a sweep that say "nothing" where something is held, each once.
  [[nodiscard]] std::vector<BeamRun> hidden_in(const SensorSweep& sweep, const Pose2& odom_from_sensor) const;
  [[nodiscard]] bool is_any_sure() const { return sure_ >= params_.named; }
  void forget() {
    places_.clear();
    seen_.clear();
    heard_ = 0;
  }

 private:
  struct Place {
    Point2 in_odom;
    Time since;
    int missed = 0;
  };
  void revise(const SweepView& view);
  /// A scanner that sees something nearer is not blind there.
  void note_nearest(const SweepView& view);
  [[nodiscard]] bool has_seen_nearer_than(double range) const;
  /// Samples in gaps in the middle of what was there. @returns whether there are any
  bool find_gaps(const SweepView& view, std::span<const float> expected, std::vector<Point2>& gone);
  void hold(const SweepView& view, std::span<const Point2> gone);
  [[nodiscard]] double nearest(const SweepView& view) const { return std::max(view.min_range, blind_within_); }

  NearThingsParams params_;
  std::vector<Place> places_;
  struct Seen {
    Time stamp;
    Point2 in_odom;
  };
  std::vector<Seen> seen_;  ///< lately, by the scanner, near
  int heard_ = 0;           ///< sweeps in succession in which the ring heard what it leaves out
  int sure_ = 0;
  int gaps_ = 0;             ///< sweeps in which one showed
  double last_flank_ = 0.0;  ///< [m]
  double blind_within_ = 0.0;
  struct Nearest {
    Time stamp;
    double range;  ///< [m] several samples were as near
  };
  std::vector<Nearest> nearest_;  ///< lately
};

}  // namespace docent::collision_avoidance
