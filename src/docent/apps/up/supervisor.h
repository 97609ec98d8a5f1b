#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "docent/apps/up/lifecycle.h"

namespace docent::apps::up_command {

/// One process to keep alive.
struct ChildSpec {
  std::string name;
  std::vector<std::string> command;  ///< program and arguments
  int niceness = 0;
  bool has_health = true;
};

/// Keeps processes alive: starts them, restarts them with a back-off, kills those that hang, and takes them along when
/// it ends, however it ends (architecture 10.10). Single-threaded: `step` never blocks and is called often, always from
/// the thread that lives longest, since the children die with the thread that started them.
class Supervisor {
 public:
  using Clock = std::chrono::steady_clock;
  enum class From { supervisor, child };  ///< whose words a line is
  /// A line for people, and the name of the child that it is about.
  using Log = std::function<void(From from, const std::string& name, const std::string& line)>;

  Supervisor(std::vector<ChildSpec> children, Log log, LifecycleParams params = {});
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;
  ~Supervisor();  ///< stop(), if nobody did

  /// Starts what is due, collects who ended, passes on what they wrote.
  void step();
  /// From now on it is these: who is not among them ends in order, the others do and start again at once, with their
  /// command; but for `kept`, which goes on as it is.
  void replace(const std::vector<ChildSpec>& children, const std::string& kept);
  void heard(const std::string& name, pid_t pid, const std::string& state, const std::string& reason);
  /// SIGTERM to all, SIGKILL to those who are still there after `patience_s`. Blocks so long.
  void stop(double patience_s = 3.0);

  /// Set when a child refused its configuration at its first start (exit code 2): its last line. Then nothing is
  /// restarted any more, because no restart would help.
  [[nodiscard]] const std::optional<std::string>& fatal() const { return fatal_; }

  struct Status {
    std::string name;
    std::string text;
    pid_t pid = 0;
    int restarts = 0;
  };
  [[nodiscard]] std::vector<Status> status() const;

 private:
  struct Child {
    ChildSpec spec;
    Lifecycle life;
    pid_t pid = 0;
    int output = -1;  ///< read end of its stdout and stderr
    std::string partial_line;
    std::string last_line;
    std::optional<Clock::time_point> told_to_end{};  ///< since then it should end, to start again
    bool retires = false;                            ///< and not start again
  };
  void start(Child& child);
  void tell_to_end(Child& child);
  [[nodiscard]] Child child_of(ChildSpec spec) const;
  void collect(Child& child);
  /// How it ended, once.
  std::optional<std::string> reap(Child& child);
  void read_output(Child& child);
  void signal_group(const Child& child, int number) const;

  std::vector<Child> children_;
  Log log_;
  LifecycleParams params_;
  std::optional<std::string> fatal_;
};

/// Exit code of a module that cannot work with what it was given.
inline constexpr int kExitBadConfiguration = 2;

}  // namespace docent::apps::up_command
