#pragma once

#include <array>

#include "docent/base/random.h"
#include "docent/interaction/attract/crowd_class.h"
#include "docent/interaction/attract/trial_memory.h"

namespace docent::interaction {

/// How the next action follows from all trials ([Minerva2000] 6.3: memory-based, without delayed reward).
struct ActionChoiceParams {
  double explore = 0.1;  ///< 0..1, at least so often it does anything at all, that it may learn what is new
  /// >= 0 trials: after so many, half of its actions are still random; 0: `explore` from the start
  double learning = 60.0;
  double kinship = 0.3;  ///< 0..1, how far a trial tells of an action that differs in one of gaze, face and speech
  /// > 0: width, in ln of density, over which a trial counts for other crowds; half the distance between quiet and busy
  double density_width = 0.7;
  /// [trials] > 0: this many imaginary trials with the average reward are added, so that a few real ones say little
  double doubt = 2.0;
  template <class V>
  void visit(V& v) {
    v("explore", explore);
    v("learning", learning);
    v("kinship", kinship);
    v("density_width", density_width);
    v("doubt", doubt);
  }
  [[nodiscard]] Result<void> validate() const;
  bool never_explores = false;  ///< crippled: takes what it knows best, and nothing else
};

/// A number for each action, by its index.
using PerAction = std::array<double, kAttractionActions>;

/// What each action is worth at a density, in standard deviations above the mean reward of that crowd: the mean of all
/// trials, weighed by how like they are. O(trials + actions^2).
[[nodiscard]] PerAction action_values(const TrialMemory& trials, double density, const ActionChoiceParams& params,
                                      const CrowdClassParams& crowds);

/// How often a choice is random after so many trials.
[[nodiscard]] double random_share(std::size_t trials, const ActionChoiceParams& params);

/// How probably each action is drawn; the sum is 1. Of those with the best value each has the same chance.
[[nodiscard]] PerAction action_chances(const PerAction& values, double random_share);
/// How probably each style is drawn with a gaze, once that gaze was drawn. @pre an action of that gaze has a chance
[[nodiscard]] StyleChances style_chances(const PerAction& chances, GazeStrategy gaze);
/// One draw.
[[nodiscard]] AttractionAction draw_action(const PerAction& chances, Rng& rng);

}  // namespace docent::interaction
