#pragma once

#include <chrono>
#include <string>

namespace docent::apps::up_command {

struct LifecycleParams {
  double first_delay_s = 0.2;  ///< before the first restart; doubles with each that follows
  double last_delay_s = 5.0;
  double healthy_s = 10.0;   ///< who lived so long starts again with the first delay
  double silent_s = 5.0;     ///< without health for so long: not responding
  double hung_s = 15.0;      ///< without health for so long: killed. A process that is stopped for 10 s may go on.
  double starting_s = 60.0;  ///< how long the way to the first health may take
};

/// When to start, restart and give up on one supervised process. Knows no process: it is told what happens and asked
/// what to do, so that it can be tested without one.
class Lifecycle {
 public:
  using Time = std::chrono::steady_clock::time_point;
  enum class Step { wait, start, kill };

  /// @param has_health  false for a process that does not report its health: it is never silent
  explicit Lifecycle(bool has_health, LifecycleParams params = {}) : params_{params}, has_health_{has_health} {}

  void started(Time now);
  void heard(Time now, std::string state, std::string reason);
  /// @param how  "exit code 3", "signal 9"
  void ended(Time now, const std::string& how);
  /// Was killed for its silence; its end is near but not known yet.
  void killed(Time now) { heard_at_ = now; }
  [[nodiscard]] Step next(Time now) const;

  [[nodiscard]] bool is_running() const { return running_; }
  [[nodiscard]] int starts() const { return starts_; }
  [[nodiscard]] double delay_s() const { return delay_s_; }
  /// "ready", "degraded: no map yet", "not responding for 7 s", "ended (signal 9), starts again in 0.2 s"
  [[nodiscard]] std::string status(Time now) const;

 private:
  [[nodiscard]] double silence_s(Time now) const;

  LifecycleParams params_;
  bool has_health_;
  bool running_ = false;
  bool heard_since_start_ = false;
  int starts_ = 0;
  double delay_s_ = 0.0;
  Time started_at_{};
  Time ended_at_{};
  Time heard_at_{};
  std::string state_ = "starting";
  std::string reason_;
  std::string how_;
};

}  // namespace docent::apps::up_command
