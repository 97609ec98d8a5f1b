#include "docent/apps/shared/log.h"

#include <spdlog/details/log_msg.h>
#include <spdlog/pattern_formatter.h>

#include <cctype>
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

}  // namespace docent::apps
