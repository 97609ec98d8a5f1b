#include "docent/apps/shared/log.h"

#include <spdlog/details/log_msg.h>
#include <spdlog/pattern_formatter.h>

#include <cctype>
#include <cmath>
#include <cstdio>

namespace docent::apps {

namespace {

constexpr std::string_view kPattern = "%Y-%m-%d %H:%M:%S.%e %l %n: %v";

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
    case LogLevel::info:
      break;
  }
  return spdlog::level::info;
}

}  // namespace

std::string log_line(LogLevel level, const std::string& module, const std::string& text) {
  spdlog::pattern_formatter formatter{std::string{kPattern}, spdlog::pattern_time_type::local, ""};
  const spdlog::details::log_msg message{module, level_of(level), text};
  spdlog::memory_buf_t buffer;
  formatter.format(message, buffer);
  return {buffer.data(), buffer.size()};
}

bool is_log_line(std::string_view line) {
  constexpr std::string_view kShape = "0000-00-00 00:00:00.000 ";
  if (line.size() <= kShape.size()) return false;
  for (std::size_t i = 0; i < kShape.size(); ++i) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(line[i])) != 0;
    if (kShape[i] == '0' ? !is_digit : line[i] != kShape[i]) return false;
  }
  return true;
}

void log_to_stderr(LogLevel level, const std::string& module, const std::string& text) {
  const std::string line = log_line(level, module, text) + "\n";
  std::fputs(line.c_str(), stderr);
}

bool Progress::is_due(double done, double wall_s) {
  constexpr double kTerminal = 0.5;  // [s] between changes of the line
  constexpr double kLeast = 2.0;     // [s] between lines through a pipe
  constexpr double kMost = 60.0;     // [s] without a line through a pipe
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

}  // namespace docent::apps
