#include "docent/apps/simulate/progress.h"

#include <cmath>

namespace docent::apps::simulate_command {
namespace {
constexpr double kTerminal = 0.5;  // [s] between changes of the line
constexpr double kLeast = 2.0;     // [s] between lines through a pipe
constexpr double kMost = 60.0;     // [s] without a line through a pipe
}  // namespace

bool Progress::is_due(double done, double wall_s) {
  const double since = wall_s - last_s_;
  const bool is_due = is_terminal_ ? since >= kTerminal : since >= kMost || (since >= kLeast && done >= next_done_);
  if (!is_due) return false;
  last_s_ = wall_s;
  next_done_ = (std::floor(done * 10.0) + 1.0) / 10.0;
  return true;
}

std::string Progress::shown(const std::string& line) const {
  return is_terminal_ ? "\r" + line + "\033[K" : line + "\n";
}

}  // namespace docent::apps::simulate_command
