#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "docent/geometry/pose2.h"
#include "docent/simulator/crowd/replay.h"
#include "docent/simulator/physique/slice.h"

namespace docent::simulator {

enum class Activity {
  stroll,      ///< walks to an attraction
  look,        ///< stands before one
  run,         ///< a child runs about
  follow,      ///< walks close behind the robot
  curious,     ///< steps in its way and waits what it does
  block,       ///< the same, for minutes
  wall,        ///< stands in a row with others, in its way
  push,        ///< walks into it from a side
  listen,      ///< stands round it while it talks
  step_aside,  ///< out of its way, after the horn
  leave,       ///< to the entrance
  stand,       ///< where a scenario put them
  escort,      ///< walks along with the robot in a ring that is open ahead
  recorded,    ///< walks as someone once walked before a camera, whatever the robot does
  press,       ///< waits until the robot comes by, then presses it in one direction with others
  romp,        ///< a child that runs about round a place and heeds nothing
};

/// One visitor. Positions in the world frame, metres and seconds.
/// What every step of the crowd reads comes first, in two cache lines.
struct alignas(64) Person {
  Point2 position{};
  Point2 velocity{};
  Point2 wanted{};                      ///< velocity that they try to take
  double radius = 0.25;                 ///< [m] the room that others leave them; their body may reach farther
  double room = 0.0;                    ///< [m] by which the clearance at `roomy_at` was more than this person needs
  Point2 roomy_at{};                    ///< where the clearance was looked up last
  std::array<std::uint16_t, 8> near{};  ///< indices of those within reach
  int near_count = 0;
  Activity activity = Activity::stroll;
  double bumped_until = 0.0;  ///< who ignored the robot and touched it minds it until then
  std::uint32_t id = 0;
  bool is_extra = false;        ///< came by a scenario or a recording: nobody comes instead when they have left
  bool has_arrived = false;     ///< for those who stand in the way: reached the goal
  bool is_inattentive = false;  ///< notices the robot late
  bool ignores_robot = false;   ///< walks and stands as if it were not there
  bool is_heedless = false;     ///< never looks; as a child, runs about besides
  Gait gait;

  bool is_child = false;
  double height = 1.7;
  double preferred_speed = 1.1;
  int group = 0;  ///< family or friends, who go from exhibit to exhibit together

  double until = 0.0;     ///< when it ends
  Point2 goal{};          ///< where they want to stand; meaning depends on the activity
  bool has_goal = false;  ///< for stroll: the spot was chosen
  int attraction = -1;    ///< index in the world's list
  double side = 1.0;      ///< +1 left, -1 right of the robot
  double slot = 0.0;      ///< [rad] for the escort: place in the ring, from the robot's heading; to press: in the map
  double ground = 0.0;    ///< [m] for a child that romps: how far it runs from where it came
  Point2 home{};          ///< where it came
  double heeds = -1.0;    ///< chance to step aside at the horn; < 0: as its activity has it
  double keeps_distance = 1.0;  ///< [m] to the robot's outline, for followers and listeners

  Walk walk;  ///< for the recorded
  Physique physique = one_disc(0.25);

  double leaves_at = 0.0;
  double bored_until = 0.0;  ///< takes no interest in the robot before
  double attention_until = 0.0;
  bool back_turned = false;  ///< while looking at an exhibit: does not notice it at all
  double reacts_at = std::numeric_limits<double>::infinity();  ///< begins to step aside
  Point2 progress_from{};
  double progress_at = 0.0;

  /// As they stand now. It must not outlive them.
  [[nodiscard]] Posture posture() const { return {position, gait.facing(), gait.swing(), &physique}; }
};

/// What people see of the robot.
struct RobotView {
  Point2 position{};     ///< [m], world
  double heading = 0.0;  ///< [rad]
  Point2 velocity{};     ///< [m/s], world
  double turn_rate = 0.0;
  double radius = 0.265;
};

}  // namespace docent::simulator
