#pragma once

#include <vector>

#include "docent/base/random.h"
#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::simulator {

/// What people see and hear of a robot that stands and attracts them.
struct Shown {
  GazeStrategy gaze = GazeStrategy::ahead;
  Mood face = Mood::neutral;
  SpeechAct speech = SpeechAct::silence;
};

/// How people answer to it. All of this is our own guess: nobody has published more than that friendly attracts more.
struct PassersByParams {
  double liking =
      0.0;  ///< a friendly robot (+1) stops exp(liking) as many groups as an even one; < 0: people like it upset
  double eye_contact = 0.2;  ///< a robot that looks at people stops exp(eye_contact) as many
  double stops = 0.3;        ///< 0..1, share of the groups that an even robot stops
  double whim =
      0.4;  ///< >= 0, standard deviation of the ln of that share from phase to phase: school classes, rain, lunch
  double notice = 3.5;    ///< [m] > 0, at which a group notices the robot and decides
  double hall = 6.0;      ///< [m] > notice, radius of what is looked at
  double pace = 1.0;      ///< [m/s] > 0, mean pace of who walks by
  double stay_s = 15.0;   ///< [s] > 0, mean time before a robot
  double distance = 1.5;  ///< [m] > 0, at which people mostly stand before it
  double pushy = 0.06;    ///< 0..1, share of those who stop and come so near that they could touch it
  int largest_group = 4;  ///< >= 1; groups of one to so many are equally frequent
};

/// People around a robot that stands: groups walk by in straight lines, and some of them stop before it for a while.
/// They are no part of the robot and share nothing with its learner but words. Deterministic by the generator.
class PassersBy {
 public:
  /// @param density  [1/m2] persons who walk by; who stops comes on top
  PassersBy(const PassersByParams& params, double density, const Rng& rng);

  /// What the robot does from now on.
  void show(const Shown& shown) { shown_ = shown; }
  /// @pre seconds > 0, some tenths
  void step(double seconds);
  /// [m], robot frame, of everybody in the hall.
  [[nodiscard]] std::vector<Point2> people() const;

 private:
  enum class Errand { passes, has_decided, comes, stands };
  struct Group {
    std::vector<Point2> places;  ///< [m] of each, beside the group's position
    Point2 position;             ///< [m], robot frame
    Point2 velocity;             ///< [m/s]
    Errand errand = Errand::passes;
    double distance = 0.0;  ///< [m] at which it wants to stand
    double stay_s = 0.0;    ///< left to stand
  };

  [[nodiscard]] Group group_at(Point2 position, Angle heading);
  [[nodiscard]] double share_that_stops() const;
  void arrive(double seconds);
  void move(Group& group, double seconds);
  void decide(Group& group);

  PassersByParams params_;
  double density_;
  Rng rng_;
  double whim_;
  Shown shown_;
  std::vector<Group> groups_;
};

}  // namespace docent::simulator
