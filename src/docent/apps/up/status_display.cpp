#include "docent/apps/up/status_display.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <utility>

namespace docent::apps::up_command {
namespace {

/// "not responding for 7 s" and its like count on: only the kind of a state is worth a line in a log.
std::string without_digits(const std::string& text) {
  std::string kind;
  for (const char c : text) {
    if (c < '0' || c > '9') kind += c;
  }
  return kind;
}

/// A module that is ready may say more of itself: "ready: slow until …".
constexpr std::string_view kReadyBut = "ready: ";
bool is_well(const std::string& text) { return text == "ready" || text == "running" || text.starts_with(kReadyBut); }
bool is_passing(const std::string& text) { return text.starts_with("degraded") || text.starts_with("starting"); }

LogLevel level_of(const std::string& text) {
  if (is_well(text) || text.starts_with("starting")) return LogLevel::info;
  return is_passing(text) ? LogLevel::warning : LogLevel::error;
}

const char* color_of(const std::string& text) {
  if (is_well(text)) return "\033[32m";
  return is_passing(text) ? "\033[33m" : "\033[31m";
}

/// Room for a status: a line that wraps could not be erased.
std::size_t room_for_text() {
  constexpr int kRest = 34;  // name and restarts
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return 80;
  return static_cast<std::size_t>(std::max(10, size.ws_col - kRest));
}

}  // namespace

StatusDisplay::StatusDisplay(bool is_terminal, std::function<void(const std::string&)> print, Clock::time_point now)
    : is_terminal_{is_terminal}, print_{std::move(print)}, start_{now} {}

std::string StatusDisplay::erased() {
  std::string text;
  for (; lines_shown_ > 0; --lines_shown_) text += "\033[1A\033[2K";
  return text;
}

void StatusDisplay::print_line(const std::string& line) {
  print_(erased() + line + "\n");
  if (is_terminal_) show_on_terminal(shown_);
}

void StatusDisplay::log(LogLevel level, const std::string& module, const std::string& text) {
  print_line(log_line(level, module, text));
}

void StatusDisplay::log_output(const std::string& module, const std::string& line) {
  print_line(is_log_line(line) ? line : log_line(LogLevel::warning, module, line));
}

void StatusDisplay::show(const std::vector<Supervisor::Status>& all, Clock::time_point now) {
  if (is_terminal_) return show_on_terminal(all);
  const bool all_well =
      !all.empty() && std::all_of(all.begin(), all.end(), [](const auto& status) { return is_well(status.text); });
  if (!has_started_ && all_well) {
    has_started_ = true;
    log(LogLevel::info, "up", "all " + std::to_string(all.size()) + " modules are ready");
    log_changes(all);
  } else {
    has_started_ = has_started_ || now - start_ > kStartTime;
    log_changes(all);
  }
}

void StatusDisplay::show_on_terminal(const std::vector<Supervisor::Status>& all) {
  std::string text = erased();
  for (const auto& status : all) {
    char name[32];
    std::snprintf(name, sizeof name, "  %-10s ", status.name.c_str());
    text += name + std::string{color_of(status.text)} + status.text.substr(0, room_for_text()) + "\033[0m";
    if (status.restarts > 0) text += "  (restarted " + std::to_string(status.restarts) + " x)";
    text += "\n";
  }
  print_(text);
  lines_shown_ = all.size();
  shown_ = all;
}

void StatusDisplay::log_changes(const std::vector<Supervisor::Status>& all) {
  for (const auto& status : all) {
    if (!has_started_ && (is_well(status.text) || is_passing(status.text) || status.text == "not started")) continue;
    auto& last = last_[status.name];
    const std::string kind = without_digits(status.text);
    if (last == kind || status.text.starts_with("ended")) continue;  // the supervisor has logged its end
    const std::string before = std::exchange(last, kind);
    // What a module says of itself while all is well is news once; that it says it no more is none.
    const bool was_well = before.empty() || is_well(before);
    const bool has_note = status.text.starts_with(kReadyBut);
    const bool is_new = has_note && notes_.insert(status.name + kind).second;
    if (was_well && is_well(status.text) && !is_new) continue;
    log(level_of(status.text), status.name, status.text);
  }
}

}  // namespace docent::apps::up_command
