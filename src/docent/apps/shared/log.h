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

}  // namespace docent::apps
