#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/interaction/head/gaze_choice.h"
#include "docent/interaction/head/neck.h"
#include "docent/interaction/mood/mood_machine.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// What the robot is to do, as far as its head cares.
struct HeadTask {
  std::string id;  ///< empty: nothing
  std::optional<TaskKind> kind;
  std::optional<Point2> shows;       ///< [m], map: what its exhibit is to be looked at
  std::optional<GazeStrategy> gaze;  ///< while it attracts people: whom it looks at
  std::optional<Mood> face;          ///< likewise: which face it wears
};

/// How that task goes.
struct HeadTaskState {
  std::string id;  ///< of the task
  std::optional<TaskStatus> status;
  std::optional<LookFor> look;
};

/// Where the robot is, and who is round it.
struct HeadSurroundings {
  std::optional<Pose2> odom_from_base;  ///< nullopt: odometry is silent
  std::optional<Pose2> map_from_base;   ///< nullopt: it does not know its place
  std::span<const SeenPerson> people;   ///< robot frame
};

/// What face and head show.
struct HeadShown {
  Mood mood = Mood::neutral;
  double valence = 0.0;
  bool is_speaking = false;
  LookAt at = LookAt::none;
  JointState pan;
  JointState tilt;
};

/// Mood, gaze and neck as one: what was heard of the task, the way and the speech becomes a face and a place to look
/// at. Whoever is silent for a second counts no more. Deterministic by the generator.
class HeadControl {
 public:
  struct Params {
    MoodParams mood;
    GazeChoiceParams gaze;
    NeckParams neck;
  };
  HeadControl(const Params& params, const Rng& rng);

  void task(HeadTask task) { task_ = std::move(task); }
  void task_state(HeadTaskState state) { state_ = std::move(state); }
  /// A person stands in the way now, and for a second.
  void block(Time now);
  /// The way is free.
  void unblock(Time now) { blocked_until_ = now; }
  /// The heading in odometry's frame that it wants to go or turn to; nullopt: none.
  void want(std::optional<Angle> heading, Time now);
  /// What lies on the floor there [m], map, is pointed at; nullopt: nothing is.
  void point_at(std::optional<Point2> in_map) { pointed_ = in_map; }
  /// A line that is spoken; false: nothing is.
  void speech(bool is_speaking, Time start, double duration_s);

  /// Ten times a second; times must not fall.
  [[nodiscard]] HeadShown step(const HeadSurroundings& around, Time now);

 private:
  [[nodiscard]] bool is_under_way() const;
  [[nodiscard]] bool is_mingling() const { return is_under_way() && task_.kind == TaskKind::mingle; }
  [[nodiscard]] HeadView view(const HeadSurroundings& around, Time now) const;

  MoodMachine mood_;
  GazeChoice gaze_choice_;
  Neck neck_;
  HeadTask task_;
  HeadTaskState state_;
  Time blocked_until_{};
  std::optional<Angle> wanted_;
  Time wanted_at_{};
  std::optional<Point2> pointed_;  ///< [m], map
  std::optional<Time> speech_end_;
};

}  // namespace docent::interaction
