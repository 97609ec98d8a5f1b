#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/museum/museum.h"
#include "operator_line.h"
#include "program.h"
#include "robot_watch.h"

namespace docent {

struct StopRobotOptions {
  std::string museum = std::string{DOCENT_SOURCES} + "/museums/bonn";
  int gateways = 2;           ///< 1: the robot's own; 2: one more, a process of its own
  std::string mode = "open";  ///< as `docent up --sim --mode`
  std::string seed = "1";
  int domain = 48;
  int port = 18048;  ///< and the next one
};

/// A robot of real processes in the simulated museum, on an odd machine, with an operator at each of its gateways. It
/// always has something to do; its processes are killed, and come back as their supervisor has them.
class StopRobot {
 public:
  using Seconds = std::chrono::duration<double>;

  explicit StopRobot(StopRobotOptions options);
  StopRobot(const StopRobot&) = delete;
  StopRobot& operator=(const StopRobot&) = delete;

  /// Its museum where the mode is `hours`: closed until half past two at night, then open, then the Web's.
  [[nodiscard]] static const museum::Museum& museum_with_hours();
  /// Localized, every gateway open to its operator.
  [[nodiscard]] bool begin();
  [[nodiscard]] OperatorLine& at(int gateway) { return *operators_.at(static_cast<std::size_t>(gateway)); }
  [[nodiscard]] int gateways() const { return options_.gateways; }
  [[nodiscard]] RobotWatch::Snapshot look() const { return watch_.look(); }
  [[nodiscard]] evaluation::DeploymentReport report() const { return watch_.report(); }
  [[nodiscard]] std::string log() { return up_->output(); }

  /// Its processes but the simulator, which is the world: modules by their names, and "gateway 2".
  [[nodiscard]] std::vector<std::string> processes() const;
  /// SIGKILL, or another signal. @returns whether it was there
  bool hit(const std::string& process, int signal);
  /// Each of them runs again, and says that it does.
  [[nodiscard]] bool are_back(const std::vector<std::string>& processes, Seconds patience);
  /// All keepers that live say the same, and every gateway shows it.
  [[nodiscard]] bool is_everywhere(bool is_stopped, Seconds patience);
  [[nodiscard]] bool drives(double speed, Seconds patience);
  [[nodiscard]] bool stands(Seconds patience);
  [[nodiscard]] double distance() const { return watch_.look().truth.distance_m; }
  /// It has somewhere to go, and only the stop keeps it.
  [[nodiscard]] bool would_drive() const;
  /// Keeps it busy meanwhile.
  [[nodiscard]] bool wait_for(const std::function<bool()>& done, Seconds patience);
  void wait(Seconds duration);

 private:
  void make_accounts() const;
  [[nodiscard]] std::filesystem::path state(int gateway) const;
  void start_second_gateway();
  void keep_busy();
  [[nodiscard]] std::map<std::string, pid_t> pids() const;

  const StopRobotOptions options_;
  TemporaryFolder folder_;
  RobotWatch watch_;
  std::unique_ptr<Program> up_, second_;
  std::vector<std::unique_ptr<OperatorLine>> operators_;
  std::map<std::string, pid_t> hit_;  ///< which process it was
  RobotWatch::Clock::time_point asked_at_{};
  std::size_t next_wish_ = 0;
};

}  // namespace docent
