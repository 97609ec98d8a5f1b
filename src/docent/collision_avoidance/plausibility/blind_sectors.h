#pragma once

#include <span>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"
#include "docent/collision_avoidance/plausibility/sweep_form.h"

namespace docent::collision_avoidance {

struct BlindSectorsParams {
  double surely_within = 0.85;  ///< of the reach: what is expected farther may well give no answer
  double least_angle = 0.26;    ///< [rad] 15 degrees: black clothes and a pane of glass take less
  double least_arc = 0.5;       ///< [m] at the expected distances, and
  double people = 2.0;          ///< [m/s] more: those who hid nothing step aside no faster
  double hole = 0.04;           ///< [rad] in such a sector of which nothing is known
  double rest = 0.6;            ///< of the samples that answer are as expected: else the robot is elsewhere
  int least_rest = 12;          ///< of them at least: a few may be as expected by chance
  double noise = 0.2;           ///< [m] for that
  double least_known = 0.6;     ///< of its samples at least were expected to answer
  double opened = 0.25;         ///< of a sector's samples answer: it looks again
  int sure = 2;                 ///< sweeps until a sector is named, and until it counts no longer
};

/// Sectors of a scanner's field in which it says that nothing is there, although something was: blind, until they
/// answer again. Samples, not bearings in the world: who turns takes a blind sector along.
class BlindSectors {
 public:
  explicit BlindSectors(const BlindSectorsParams& params = {}) : params_{params} {}

  /// Follows the known sectors. To be called once a sweep, before `look_for`.
  void follow(const SweepView& view);
  /// @param expected  [samples] [m] where they should meet something; NaN: not known
  /// @param elapsed  [s] since that was seen
  /// @param hole  [rad] wider than the params', where what hid a wall is not expected itself
  void look_for(const SweepView& view, std::span<const float> expected, double elapsed, double hole = 0.0);
  void forget() { sectors_.clear(); }
  /// Sectors of the last sweeps: the robot was carried off at that moment.
  void forget_newest();

  /// [samples of the newest view) that are not to be believed when they say that nothing is there.
  [[nodiscard]] std::vector<BeamRun> runs() const;
  /// A sector has been blind for long enough to be named.
  [[nodiscard]] bool is_any_sure() const;

 private:
  struct Sector {
    BeamRun run;
    int sweeps = 0;
    int opened = 0;
  };
  void add(const SweepView& view, BeamRun run);

  BlindSectorsParams params_;
  std::vector<Sector> sectors_;
  std::size_t samples_ = 0;
};

}  // namespace docent::collision_avoidance
