#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/planning/detour/detour.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::task_control {

/// How long the robot waits before each step of the ladder, counted from the last progress.
struct LadderParams {
  bool active = true;                    ///< false: crippled, for evaluation: it stands before what is in its way
  bool asks = true;                      ///< false: crippled, for evaluation: it asks nobody for way
  double horn_after_s = 1.5;             ///< [s] >= 0 behind something unmapped, without progress
  double horn_every_s = 6.0;             ///< [s] > 0
  double wait_after_s = 4.0;             ///< [s] > 0
  double ask_after_s = 6.0;              ///< [s] >= wait_after_s
  double ask_every_s = 15.0;             ///< [s] > 0
  double patience_s = 90.0;              ///< [s] > ask_after_s without progress, then something else is chosen
  double unreachable_patience_s = 20.0;  ///< [s] > 0: people may close the only way for a moment
  double thing_patience_s = 20.0;        ///< [s] > 0 without progress before a thing: it does not step aside
  double calm_s = 3.0;                   ///< [s] > 0 of progress until the way counts as free
  double flicker_s = 0.6;                ///< [s] >= 0: somebody who is out of sight for less is still in the way
  double driving_s = 1.5;                ///< [s] > 0: the robot still drives while its last progress is less old
  template <class V>
  void visit(V& v) {
    v("horn_after_s", horn_after_s);
    v("horn_every_s", horn_every_s);
    v("wait_after_s", wait_after_s);
    v("ask_after_s", ask_after_s);
    v("ask_every_s", ask_every_s);
    v("patience_s", patience_s);
    v("unreachable_patience_s", unreachable_patience_s);
    v("thing_patience_s", thing_patience_s);
    v("calm_s", calm_s);
    v("flicker_s", flicker_s);
    v("driving_s", driving_s);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What the ladder sees of a drive.
struct LadderView {
  bool is_hindered = false;         ///< an obstacle in the wanted direction holds the robot up
  bool is_unmapped = false;         ///< and it is not in the map: likely a person
  bool is_unreachable = false;      ///< the planner knows no way
  double without_progress_s = 0.0;  ///< [s] along the value function
  planning::Detour detour = planning::Detour::none;
  std::string cause;        ///< what is in the way: a word of ReasonWord, or a diagnosis in English
  bool is_thing = false;    ///< the obstacle, or what has touched the robot here, is a thing: it hears nothing
  bool is_in_vain = false;  ///< it moves, but comes no nearer to its goal
};

/// A step that is taken now.
struct LadderStep {
  Rung rung = Rung::slow;
  std::string cause;
  double after_s = 0.0;  ///< [s] since the blockage began
  int count = 1;         ///< how often since then
};

/// What the robot does about a blocked way, step by step, each with a time constant of its own ([Rhino1999] 5.3):
///
///   slow            the collision avoidance holds the robot up
///   horn            something unmapped stands there and there is no progress; again every few seconds
///   local_detour    the way leads round it, and comes back to the one that was meant
///   global_detour   the modified map leads another way altogether
///   wait, ask       no way round: it stands, and says so
///   give_up         patience is over, or the robot goes to and fro in vain: the mission chooses something else, and
///                   tries this again later
///   free            it drives again
///
/// Nobody speaks to a thing: before one there is no horn and no asking, and less patience. The planner knows it by then
/// and has taken the detour, if there is any.
///
/// Detours are the planner's and the avoidance's doing; the ladder only tells of them. Deterministic; knows nothing of
/// messages.
class ReactionLadder {
 public:
  explicit ReactionLadder(const LadderParams& params) : params_{params} {}

  /// Another drive: what was in the way of the last one is forgotten.
  void restart() {
    episode_.reset();
    detour_ = planning::Detour::none;
  }
  /// Several times a second while driving. @returns the steps that are taken now, in their order.
  [[nodiscard]] std::vector<LadderStep> step(const LadderView& view, Time now);

 private:
  /// From the first sign of a blockage until the way was free for a while.
  struct Episode {
    Time began;
    std::optional<Time> unmapped_since;
    std::optional<Time> unmapped_seen;
    std::optional<Time> unreachable_since;
    std::optional<Time> calm_since;
    bool was_hindered = false;
    bool by_thing = false;  ///< what hindered or touched it last is a thing
    bool waits = false;
    std::map<Rung, int> counts;
    std::map<Rung, Time> last;
  };
  void look(const LadderView& view, Time now);
  void take(Rung rung, const LadderView& view, Time now, std::vector<LadderStep>& steps);
  [[nodiscard]] bool is_due_again(Rung rung, double period_s, Time now) const;
  void climb(const LadderView& view, Time now, std::vector<LadderStep>& steps);

  LadderParams params_;
  std::optional<Episode> episode_;
  planning::Detour detour_ = planning::Detour::none;  ///< that was told
};

}  // namespace docent::task_control
