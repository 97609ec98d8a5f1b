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

}  // namespace docent::telepresence::documents
