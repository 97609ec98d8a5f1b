#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "docent/museum/museum.h"
#include "program.h"
#include "robot_watch.h"

namespace docent {

/// Beyond this no module may take to be back after a kill [s].
inline constexpr double kWorstBack = 6.0;

struct KillTrialOptions {
  std::string museum = std::string{DOCENT_SOURCES} + "/museums/bonn";
  std::string crowd = "quiet";
  std::string seed = "1";
  int domain = 45;
  std::string port = "18045";
  bool is_verbose = false;  ///< says every two seconds what the robot does
};

/// One module hit once.
struct KillTrial {
  std::string module;
  std::string signal;
  std::string situation;
  double waited_s = 0.0;          ///< for the situation
  double speed = 0.0;             ///< [m/s] true, at the signal
  std::optional<double> back_s;   ///< until its state was current again: from the kill, or from the continuation
  std::optional<double> stood_s;  ///< until the robot stood, where it must
  bool stood_still = true;        ///< from then to the continuation
  int contacts = 0;
  std::optional<double> went_on_s;  ///< until the tour had gone on
  std::string fault;                ///< empty: good
};

/// A robot of processes in the simulated museum that always has something to do, and whose modules are hit.
class KillTrials {
 public:
  KillTrials(KillTrialOptions options, museum::Museum museum);

  /// Localized, with something to do.
  [[nodiscard]] bool begin();

  KillTrial run(const std::string& module, const std::string& signal, const std::string& situation);
  [[nodiscard]] evaluation::DeploymentReport report() const { return watch_.report(); }
  [[nodiscard]] std::string log() { return up_.output(); }
  /// A module that this robot runs.
  [[nodiscard]] bool has(const std::string& module) { return watch_.look().health.contains(module); }

 private:
  [[nodiscard]] std::string start_pose() const;
  void keep_busy();
  [[nodiscard]] bool is_in(const std::string& situation, const RobotWatch::Snapshot& now) const;
  [[nodiscard]] bool is_back(const std::string& module, int old_pid, bool was_killed,
                             RobotWatch::Clock::time_point since, const RobotWatch::Snapshot& before) const;
  void show();
  void hold_up(int pid, KillTrial& trial);
  void slow_down(int pid);
  [[nodiscard]] bool goes_on(const RobotWatch::Snapshot& before);
  [[nodiscard]] bool wait_for(const std::function<bool()>& done, std::chrono::duration<double> patience);

  KillTrialOptions options_;
  museum::Museum museum_;
  TemporaryFolder state_;
  RobotWatch watch_;
  Program up_;
  RobotWatch::Clock::time_point asked_at_{};
  RobotWatch::Clock::time_point shown_at_{};
  std::size_t next_wish_ = 0;
};

}  // namespace docent
