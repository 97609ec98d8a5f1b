#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::interaction {

/// At whom and what the robot looks.
struct GazeChoiceParams {
  double in_way = 0.7;     ///< [m] > 0, beside the wanted direction: who is nearer to that line stands in the way
  double way_reach = 3.0;  ///< [m] > 0, so far along it
  double standing = 0.4;   ///< [m/s] > 0: who is faster walks past and does not stand in the way
  double company = 4.0;    ///< [m] > 0: a visitor farther away does not listen
  double loyalty = 0.6;    ///< [m] >= 0, by which somebody else must be nearer before the robot turns to them
  double turn_s = 4.0;     ///< [s] > 0 for each person, where it looks at everybody in turn
  double eyes = 1.35;      ///< [m] > 0, height of the robot's eyes
  double faces = 1.55;     ///< [m] > 0, height of people's faces, children and grown-ups together
  double exhibit = 1.2;    ///< [m] > 0, height of what is shown
  double on_floor = 0.1;   ///< [m] > 0, height of what lies on the floor
  double nearest = 0.5;    ///< [m] > 0: what is nearer is tilted to as if it were so far away
  template <class V>
  void visit(V& v) {
    v("in_way", in_way);
    v("way_reach", way_reach);
    v("standing", standing);
    v("company", company);
    v("loyalty", loyalty);
    v("turn_s", turn_s);
    v("eyes", eyes);
    v("faces", faces);
    v("exhibit", exhibit);
    v("on_floor", on_floor);
    v("nearest", nearest);
  }
  [[nodiscard]] Result<void> validate() const;
};

struct SeenPerson {
  std::uint32_t id = 0;
  Point2 position;  ///< [m], robot frame
  Point2 velocity;  ///< [m/s], over the floor, in the robot's axes
};

/// What the head knows. Whatever is unknown is absent; nothing stands for a guess.
struct HeadView {
  std::optional<TaskKind> task;      ///< nullopt: nothing to do
  std::optional<TaskStatus> status;  ///< of the task
  std::optional<LookFor> look;       ///< what the task under way says; nullopt: nothing, and the status decides
  std::optional<Point2> exhibit;     ///< [m], robot frame: what the task's exhibit shows
  std::optional<Angle> wanted;       ///< robot frame: the direction in which it wants to go, or the heading it turns to
  std::optional<Point2> pointed{};   ///< [m], robot frame: what lies on the floor and is pointed at
  bool is_blocked = false;           ///< a person stands in its way
  std::span<const SeenPerson> people;
  GazeStrategy company = GazeStrategy::nearest;  ///< whom it looks at while it has nothing to do or attracts people
};

/// Where to look, robot frame.
struct GazeTarget {
  LookAt at = LookAt::none;
  std::uint32_t person = 0;  ///< id, where `at` is a person or visitor
  double pan = 0.0;          ///< [rad] to the left, -pi..pi
  double tilt = 0.0;         ///< [rad] upwards
};

/// The one place that decides where the robot looks ([Rhino1999] 5.1 (2) and 5.3, [Minerva2000] 6.2 and 6.3,
/// [Markov1998] 4.3):
///
///   pointed         at what lies on the floor
///   blocked         at the person who stands where it wants to go, else in the wanted direction
///   driving         at somebody who stands in the way, else as below
///   place           at the exhibit
///   visitors        at a visitor, else at the exhibit
///   way             in the wanted direction
///   company         at people, as `HeadView::company` says, else straight on
///   nobody          straight on
///
/// Where the task says nothing of it, it looks for the place while it drives to an exhibit, along the way while it
/// drives elsewhere, for visitors while it explains and asks, and for company while it has nothing to do.
///
/// It keeps to a person until somebody else is clearly nearer. Deterministic.
class GazeChoice {
 public:
  explicit GazeChoice(const GazeChoiceParams& params) : params_{params} {}
  /// O(people). Times must not fall.
  [[nodiscard]] GazeTarget choose(const HeadView& view, Time now);

 private:
  [[nodiscard]] static LookFor look_of(const HeadView& view);
  [[nodiscard]] GazeTarget at_things(const HeadView& view, LookFor look) const;
  [[nodiscard]] const SeenPerson* in_the_way(const HeadView& view) const;
  [[nodiscard]] const SeenPerson* company(const HeadView& view, GazeStrategy strategy, Time now);
  [[nodiscard]] const SeenPerson* next_of(std::span<const SeenPerson> people) const;
  [[nodiscard]] GazeTarget at_person(const SeenPerson& person, LookAt at) const;
  [[nodiscard]] double tilt_to(Point2 place, double height) const;

  GazeChoiceParams params_;
  std::uint32_t last_person_ = 0;  ///< whom it looked at last; 0: nobody
  Time since_;                     ///< when it began to look at them
};

}  // namespace docent::interaction
