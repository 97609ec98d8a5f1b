#pragma once

#include <cstddef>
#include <vector>

#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"

namespace docent::collision_avoidance {

struct SweepFormParams {
  double beyond = 8.0;        ///< of its own reach: a driver may state too little, and a centimetre is 100 times as far
  double many_beyond = 0.1;   ///< of the beams,
  double few_within = 0.1;    ///< and at most so many end within reach
  double tiny = 0.03;         ///< [m] and less all round: metres were meant to be something else
  double many_tiny = 0.5;     ///< of the beams
  int several = 5;            ///< different readings: one that is always the same is a driver's way to say "nothing"
  double few_answers = 0.01;  ///< of the beams: the strays of a scanner that meets nothing
  double silent_share = 0.65;  ///< of the beams at least say that nothing is there; else too few readings are named
  double inside = 0.05;        ///< [m] within the body: there is nothing but what covers the scanner
  double covered = 0.26;       ///< [rad] 15 degrees of it
  double near = 0.05;          ///< [m] and
  double near_share = 0.15;    ///< of min_range more than min_range: so near are the flanks of what is too near
  double least_gap = 0.05;     ///< [rad] 3 degrees between them
};

/// Beams [first, end) of a sweep.
struct BeamRun {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// What a single sweep shows of the scanner that took it.
struct SweepForm {
  bool has_wrong_units = false;     ///< readings far beyond its own reach, or all of them within a hand's breadth
  bool is_covered = false;          ///< something ends a part of the beams within the body
  bool is_silent = false;           ///< it says that nothing is there, all round
  std::vector<BeamRun> too_near{};  ///< "nothing there" between two readings that are hardly farther than min_range
};

/// Whether what is too near to the scanner to be seen can be outside the body. @param nearest  [m] that it sees
[[nodiscard]] bool can_be_too_near(const SensorSweep& sweep, double nearest, const BaseLimits& limits);
/// O(beams). @param nearest  [m] that the scanner sees: its min_range, or more
[[nodiscard]] SweepForm form_of(const SensorSweep& sweep, double nearest, const BaseLimits& limits,
                                const SweepFormParams& params = {});

}  // namespace docent::collision_avoidance
