#include "docent/interaction/kiosk/poll.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

namespace docent::interaction {
namespace {

/// "2026-11-24,13"
std::string day_and_hour(Time now) {
  const auto since = std::chrono::floor<std::chrono::hours>(now - Time{});
  const auto day = std::chrono::floor<std::chrono::days>(since);
  const std::chrono::year_month_day date{std::chrono::sys_days{day}};
  char text[32];
  std::snprintf(text, sizeof text, "%04d-%02u-%02u,%02d", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                static_cast<int>((since - day).count()));
  return text;
}

}  // namespace

Result<void> Poll::add(const PollEntry& entry, Time now) {
  constexpr std::size_t kKnown = 64;  // more than a screen can have under way
  if (std::find(known_.begin(), known_.end(), entry.id) != known_.end()) return {};
  std::error_code error;
  const bool is_new = !std::filesystem::exists(file_, error);
  std::ofstream file{file_, std::ios::app};
  if (is_new) file << "day,hour,language,question,answer\n";
  file << day_and_hour(now) << ',' << entry.language << ',' << to_text(entry.question) << ',' << to_text(entry.answer)
       << '\n';
  file.close();
  if (!file) return fail(file_.string() + ": cannot be written");
  known_.push_back(entry.id);
  if (known_.size() > kKnown) known_.pop_front();
  return {};
}

}  // namespace docent::interaction
