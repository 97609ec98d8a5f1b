#include "docent/apps/status_display.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace docent {
namespace {

/// "not responding for 7 s" and its like count on: only the kind of a state is worth a line in a log.
std::string without_digits(const std::string& text) {
  std::string kind;
  for (const char c : text) {
    if (c < '0' || c > '9') kind += c;
  }
  return kind;
}

const char* color_of(const std::string& text) {
  if (text == "ready" || text == "running") return "\033[32m";
  if (text.starts_with("degraded") || text == "starting") return "\033[33m";
  return "\033[31m";
}

/// Room for a status: a line that wraps could not be erased.
int room_for_text() {
  constexpr int kRest = 34;  // name and restarts
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return std::max(10, size.ws_col - kRest);
}

}  // namespace

void StatusDisplay::erase() {
  for (; lines_shown_ > 0; --lines_shown_) std::fputs("\033[1A\033[2K", stdout);
}

void StatusDisplay::log(const std::string& name, const std::string& line) {
  erase();
  std::printf("%-10s %s\n", name.c_str(), line.c_str());
  if (is_terminal_) show(shown_);
  std::fflush(stdout);
}

void StatusDisplay::show(const std::vector<Supervisor::Status>& all) {
  if (is_terminal_) {
    erase();
    for (const auto& status : all) {
      std::printf("  %-10s %s%.*s\033[0m", status.name.c_str(), color_of(status.text), room_for_text(),
                  status.text.c_str());
      if (status.restarts > 0) std::printf("  (restarted %d x)", status.restarts);
      std::fputc('\n', stdout);
    }
    lines_shown_ = all.size();
    shown_ = all;
  } else {
    for (const auto& status : all) {
      auto& last = last_[status.name];
      const std::string kind = without_digits(status.text);
      if (last == kind || status.text.starts_with("ended")) continue;  // the supervisor has logged its end
      last = kind;
      std::printf("%-10s %s\n", status.name.c_str(), status.text.c_str());
    }
  }
  std::fflush(stdout);
}

}  // namespace docent
