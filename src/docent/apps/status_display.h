#pragma once

#include <map>
#include <string>

#include "docent/apps/supervisor.h"

namespace docent {

/// What a person sees of the supervisor. On a terminal: one live line a module below the log. Elsewhere: a line
/// whenever the state of a module changes.
class StatusDisplay {
 public:
  explicit StatusDisplay(bool is_terminal) : is_terminal_{is_terminal} {}
  void log(const std::string& name, const std::string& line);
  void show(const std::vector<Supervisor::Status>& all);
  /// Leaves the last lines standing.
  void finish() { lines_shown_ = 0; }

 private:
  void erase();
  bool is_terminal_;
  std::size_t lines_shown_ = 0;
  std::map<std::string, std::string> last_;
  std::vector<Supervisor::Status> shown_;
};

}  // namespace docent
