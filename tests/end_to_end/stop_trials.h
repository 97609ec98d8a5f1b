#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odd_machine.h"
#include "stop_robot.h"

namespace docent {

/// Two processes, in the order in which they are killed.
struct Pair {
  std::string first, second;
};

/// A stop that is pressed and acknowledged, two processes that die in that order, twice, and a release.
struct StopTrial {
  Pair pair;
  int gateways = 1;
  bool is_full = false;
  double speed = 0.0;           ///< [m/s] at the press
  double acknowledged_s = 0.0;  ///< from the press
  double way_m = 0.0;           ///< driven from when it stood until the release
  double turned = 0.0;          ///< [rad] likewise
  bool would_drive = false;     ///< all the time it had somewhere to go
  double back_s = 0.0;          ///< until both were there again, the second time
  double released_s = 0.0;      ///< from the release until all keepers and gateways say so
  double went_s = 0.0;          ///< until it drove
  std::string fault;            ///< empty: good
};

/// Kills pairs of a robot's processes while it is stopped.
class StopTrials {
 public:
  /// @param is_full  the disk takes nothing from before the press until it is released everywhere
  StopTrials(StopRobot& robot, OddMachine& machine, bool is_full)
      : robot_{robot}, machine_{machine}, is_full_{is_full} {}

  /// @param is_pressed  false: nobody presses, and the robot has to drive, or a lost stop would not be seen
  StopTrial run(const Pair& pair, bool is_pressed = true);
  /// A press, all these pairs, a release: the robot stands meanwhile.
  std::vector<StopTrial> run_together(const std::vector<Pair>& pairs);

 private:
  [[nodiscard]] bool press(StopTrial& trial, bool is_pressed);
  void kill_twice(StopTrial& trial, std::chrono::duration<double> watched);
  /// Adds what it has moved since the last look: none is left out between the press and the release.
  void measure(StopTrial& trial);
  void release(StopTrial& trial);
  [[nodiscard]] bool may_be_away(const std::string& process) const;

  StopRobot& robot_;
  OddMachine& machine_;
  const bool is_full_;
  int next_gateway_ = 0;
  docent_msgs::TrueState seen_;
};

}  // namespace docent
