#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>

#include "docent/apps/shared/log.h"
#include "docent/apps/up/supervisor.h"

namespace docent::apps::up_command {

/// What a person sees of the supervisor. On a terminal: one live line a module below the log. Elsewhere: a line of the
/// log whenever the state of a module changes; that modules wait for each other while they start is no news, so a
/// healthy start is one line, with one more for each module that is ready and says something of itself.
class StatusDisplay {
 public:
  using Clock = Supervisor::Clock;
  static constexpr std::chrono::seconds kStartTime{30};  ///< what a robot may take to find itself; then all is said
  /// @param print  gets what shall stand on the screen
  StatusDisplay(bool is_terminal, std::function<void(const std::string&)> print, Clock::time_point now);

  void log(LogLevel level, const std::string& module, const std::string& text);
  /// What a module wrote itself: as it is where it is a line of a log, else as a warning of that module.
  void log_output(const std::string& module, const std::string& line);
  void show(const std::vector<Supervisor::Status>& all, Clock::time_point now);
  /// Leaves the last lines standing.
  void finish() { lines_shown_ = 0; }

 private:
  void print_line(const std::string& line);
  void show_on_terminal(const std::vector<Supervisor::Status>& all);
  void log_changes(const std::vector<Supervisor::Status>& all);
  [[nodiscard]] std::string erased();

  bool is_terminal_;
  std::function<void(const std::string&)> print_;
  Clock::time_point start_;
  bool has_started_ = false;  ///< all were ready once, or the time for that is over
  std::size_t lines_shown_ = 0;
  std::map<std::string, std::string> last_;  ///< kind of what was said last, by module
  std::set<std::string> notes_;              ///< what modules said of themselves while they were ready
  std::vector<Supervisor::Status> shown_;
};

}  // namespace docent::apps::up_command
