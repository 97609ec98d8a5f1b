#pragma once

#include <string>
#include <string_view>

namespace docent::apps {

enum class LogLevel { info, warning, error };

/// A line of a log, as every program of the robot writes it: "2026-11-24 10:15:02.123 warning localize: TEXT".
/// Local time.
[[nodiscard]] std::string log_line(LogLevel level, const std::string& module, const std::string& text);
/// Whether a line has that shape already.
[[nodiscard]] bool is_log_line(std::string_view line);

/// Writes such a line to the standard error output at once.
void log_to_stderr(LogLevel level, const std::string& module, const std::string& text);

/// What a long run tells on stderr: a line that changes in place on a terminal, else a line now and then.
class Progress {
 public:
  /// Through a pipe a line comes with each tenth of the way, but not within 2 s of the one before and not after 60 s
  /// without one [s of the wall]: a short run says nothing, and a long one stays readable in a log.
  explicit Progress(bool is_terminal) : is_terminal_{is_terminal} {}

  /// `done`: share of the way. True when `line` is to be shown.
  [[nodiscard]] bool is_due(double done, double wall_s);
  /// As it goes to stderr.
  [[nodiscard]] std::string shown(const std::string& line) const;
  /// Clears the line of a terminal.
  [[nodiscard]] std::string end() const { return is_terminal_ ? "\r\033[K" : ""; }

 private:
  bool is_terminal_;
  double last_s_ = 0.0;
  double next_done_ = 0.1;
};

}  // namespace docent::apps
