#pragma once

#include <string>
#include <vector>

#include "docent/messages/standard_messages.h"

// From a goal to the wheels, and where the head looks meanwhile.

namespace docent::docent_msgs {

/// Where to go; latched, from executive to plan. An empty id means: stay.
struct DriveGoal {
  static constexpr const char* kType = "docent_msgs/msg/DriveGoal";
  std::string id;
  double x = 0;  ///< [m], map
  double y = 0;
  double theta = 0;                  ///< [rad], heading to take on arrival
  double position_tolerance = 0.25;  ///< [m]
  double heading_tolerance = 0.1;    ///< [rad]
  bool relocalize = false;           ///< turn on the spot until localized; x, y, theta do not matter
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("id", m.id);
    v("x", m.x);
    v("y", m.y);
    v("theta", m.theta);
    v("position_tolerance", m.position_tolerance);
    v("heading_tolerance", m.heading_tolerance);
    v("relocalize", m.relocalize);
  }
};

/// What plan says of the goal; latched.
struct GoalState {
  static constexpr const char* kType = "docent_msgs/msg/GoalState";
  std_msgs::Header header;
  std::string id;
  std::string state;        ///< idle, waiting (no pose or no plan yet), driving, turning, arrived, blocked, unreachable
  double remaining_m = 0;   ///< along the path
  double straight_m = 0;    ///< as the crow flies; 0 while the robot does not know its place
  double blocked_s = 0;     ///< no progress for so long
  std::string reason;       ///< in English, for logs
  std::string detour;       ///< none, local, global: how the way differs from the one that was meant
  double detour_extra = 0;  ///< [m] that it is longer
  bool occupied = false;    ///< something that is not in the map stands where the robot would stand
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("id", m.id);
    v("state", m.state);
    v("remaining_m", m.remaining_m);
    v("straight_m", m.straight_m);
    v("blocked_s", m.blocked_s);
    v("reason", m.reason);
    v("detour", m.detour);
    v("detour_extra", m.detour_extra);
    v("occupied", m.occupied);
  }
};

/// Where the robot wants to go, for the head: it looks there while its way is blocked ([Rhino1999] 5.3). From plan, 5
/// Hz.
struct Gaze {
  static constexpr const char* kType = "docent_msgs/msg/Gaze";
  std_msgs::Header header;  ///< frame odom
  std::string at;           ///< way: the direction it wants to drive; goal: the heading it turns to; none
  double heading = 0;       ///< [rad], odom: the direction itself, good while the robot turns
  double bearing = 0;       ///< [rad], base_link at the header's stamp
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("at", m.at);
    v("heading", m.heading);
    v("bearing", m.bearing);
  }
};

/// What avoid shall steer for; from plan at 4 Hz or more. Via-points only, never a velocity.
struct Target {
  static constexpr const char* kType = "docent_msgs/msg/Target";
  std_msgs::Header header;  ///< frame odom
  std::string goal_id;
  std::string mode;           ///< stop, drive, turn
  std::vector<double> via_x;  ///< [m], odom; the next points of the way, nearest first
  std::vector<double> via_y;  ///< [m]
  bool is_final = false;      ///< the last via-point is the goal itself: slow down and stop there
  double heading = 0;         ///< [rad], odom; for turn: heading to take
  double position_tolerance = 0.25;
  double heading_tolerance = 0.1;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("goal_id", m.goal_id);
    v("mode", m.mode);
    v("via_x", m.via_x);
    v("via_y", m.via_y);
    v("is_final", m.is_final);
    v("heading", m.heading);
    v("position_tolerance", m.position_tolerance);
    v("heading_tolerance", m.heading_tolerance);
  }
};

/// The one velocity command, from avoid to robot (architecture 10.7).
struct Drive {
  static constexpr const char* kType = "docent_msgs/msg/Drive";
  std_msgs::Header header;
  double linear = 0;   ///< [m/s]
  double angular = 0;  ///< [rad/s]
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("linear", m.linear);
    v("angular", m.angular);
  }
};

/// One evaluated velocity pair.
struct Candidate {
  static constexpr const char* kType = "docent_msgs/msg/Candidate";
  float linear = 0;
  float angular = 0;
  float value = 0;  ///< < 0: not admissible
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("linear", m.linear);
    v("angular", m.angular);
    v("value", m.value);
  }
};

/// What avoid does and why; with the live velocity space.
struct AvoidState {
  static constexpr const char* kType = "docent_msgs/msg/AvoidState";
  std_msgs::Header header;
  std::string state;     ///< driving, turning, stopped, blocked
  std::string reason;    ///< why it stands or is slow: a word of ReasonWord, or in English what is broken or missing
  double speed_cap = 0;  ///< [m/s]
  double linear = 0;     ///< commanded
  double angular = 0;
  bool path_blocked = false;       ///< wants to move, and an obstacle in the wanted direction prevents it
  bool unmapped_obstacle = false;  ///< that obstacle is not in the map: likely a person
  double nearest_real_m = 0;       ///< [m] from the robot's outline
  double nearest_virtual_m = 0;
  std::vector<Candidate> window;
  bool low_obstacle =
      false;  ///< it, or what has touched the robot here, lies below the lasers, which see nobody: a thing
  /// How often, since `avoid` began, the scans could not follow one another, whatever the base did: somebody has
  /// carried the robot elsewhere.
  std::uint32_t carried_off = 0;
  template <class Self, class V>
  static void visit(Self& m, V& v) {
    v("header", m.header);
    v("state", m.state);
    v("reason", m.reason);
    v("speed_cap", m.speed_cap);
    v("linear", m.linear);
    v("angular", m.angular);
    v("path_blocked", m.path_blocked);
    v("unmapped_obstacle", m.unmapped_obstacle);
    v("nearest_real_m", m.nearest_real_m);
    v("nearest_virtual_m", m.nearest_virtual_m);
    v("window", m.window);
    v("low_obstacle", m.low_obstacle);
    v("carried_off", m.carried_off);
  }
};

}  // namespace docent::docent_msgs
