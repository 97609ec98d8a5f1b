#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "docent/vocabulary/vocabulary.h"

// What /api/v1/robot takes and gives: a robot that is sent about from elsewhere.

namespace docent::telepresence::documents {

/// What became of a place to which somebody of the staff has sent the robot.
struct RobotGoalState {
  static constexpr const char* kName = "RobotGoalState";
  std::string id;
  RequestStatus state{};
  std::string reason;  ///< a word of ReasonWord, alone or with what it is about; empty: none
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("state", d.state), v("reason", d.reason);
  }
};

/// How the robot is now.
struct RobotState {
  static constexpr const char* kName = "RobotState";
  double t = 0.0;                             ///< [s] of the robot's clock
  std::optional<std::array<double, 3>> pose;  ///< x, y [m], heading [rad], map; null: it does not know its place
  std::optional<double> battery;              ///< 0..1; null: it has none that speaks
  bool is_charging = false;
  std::string phase;                  ///< a word of MissionPhase; empty: nobody has said
  bool is_stopped = false;            ///< somebody has pressed the stop button
  double remaining_m = 0.0;           ///< to where it drives now, along its path
  std::vector<RobotGoalState> goals;  ///< of the staff, those on the robot's board, the oldest first
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("t", d.t), v("pose", d.pose), v("battery", d.battery), v("is_charging", d.is_charging), v("phase", d.phase),
        v("is_stopped", d.is_stopped), v("remaining_m", d.remaining_m), v("goals", d.goals);
  }
};

/// Where it shall go.
struct RobotGoal {
  static constexpr const char* kName = "RobotGoal";
  std::string id;        ///< a UUID of version 7, made by the caller: the same again is the same goal
  double x = 0.0;        ///< [m], map
  double y = 0.0;        ///< [m], map
  double heading = 0.0;  ///< [rad], to take there
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("x", d.x), v("y", d.y), v("heading", d.heading);
  }
};

/// What it shall do in an office.
struct OfficeWish {
  static constexpr const char* kName = "OfficeWish";
  std::string id;    ///< a UUID of version 7, made by the caller: the same again is the same order
  std::string kind;  ///< deliver, tidy, confirm, stop
  std::string room;  ///< for deliver: its id; for tidy: one room, or empty for all
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("kind", d.kind), v("room", d.room);
  }
};

/// How that goes.
struct OfficeReport {
  static constexpr const char* kName = "OfficeReport";
  std::string id;    ///< of the order; empty: there was none yet
  std::string kind;  ///< of it
  std::string
      phase;  ///< idle, driving, handing_over, looking, approaching, checking, asking, to_bin, emptying, done, failed
  std::string room;    ///< of it
  std::string reason;  ///< why it failed, in English
  int found = 0;       ///< things to tidy up that it was sure of
  int picked_up = 0;   ///< of these somebody has put into its bin
  int left = 0;        ///< nobody has
  int in_bin = 0;      ///< now
  template <class Self, class V>
  static void visit(Self& d, V& v) {
    v("id", d.id), v("kind", d.kind), v("phase", d.phase), v("room", d.room), v("reason", d.reason),
        v("found", d.found), v("picked_up", d.picked_up), v("left", d.left), v("in_bin", d.in_bin);
  }
};

}  // namespace docent::telepresence::documents
