#include "docent/museum/wall_clock.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <ctime>

namespace docent::museum {
namespace {

constexpr Duration kSet = std::chrono::seconds{2};  // at once: what keeps a clock right turns it more gently
constexpr Duration kTold = std::chrono::minutes{10};

std::tm local_time(Duration wall) {
  const auto seconds = static_cast<std::time_t>(std::chrono::floor<std::chrono::seconds>(wall).count());
  std::tm local{};
  localtime_r(&seconds, &local);
  return local;
}

int local_minute(Duration wall) {
  const std::tm local = local_time(wall);
  return local.tm_hour * 60 + local.tm_min;
}

std::string in_words(Duration step) {
  const auto seconds = std::chrono::round<std::chrono::seconds>(std::chrono::abs(step)).count();
  const std::string rest = std::to_string(seconds % 60) + " s";
  return seconds < 60 ? rest : std::to_string(seconds / 60) + " min " + rest;
}

}  // namespace

int WallClock::minute_of_day(Time now) const {
  if (!is_virtual_) return local_minute(clocks_.wall());
  const auto minutes = std::chrono::floor<std::chrono::minutes>(day_begins_ + Duration{now.nanoseconds});
  return static_cast<int>(minutes.count() % (std::int64_t{24} * 60));
}

std::int64_t WallClock::day(Time now) const {
  constexpr std::int64_t kLongestYear = 366;  // [d]
  if (is_virtual_) return std::chrono::floor<std::chrono::days>(day_begins_ + Duration{now.nanoseconds}).count();
  const std::tm local = local_time(clocks_.wall());
  return local.tm_year * kLongestYear + local.tm_yday;
}

void WallClock::look() {
  if (is_virtual_) return;
  const Duration wall = clocks_.wall();
  const Duration steady = clocks_.steady();
  const Duration apart = wall - steady;
  const Duration step = apart_ ? apart - *apart_ : Duration{};
  apart_ = apart;
  if (std::chrono::abs(step) < kSet) return;
  char at[16];
  const int minute = local_minute(wall - step);
  std::snprintf(at, sizeof at, "%02d:%02d", minute / 60, minute % 60);
  change_ = std::string{"the clock was set "} + (step < Duration{} ? "back" : "ahead") + " by " + in_words(step) +
            " at " + at;
  changed_at_ = steady;
}

std::string WallClock::change() const {
  return !change_.empty() && clocks_.steady() - changed_at_ < kTold ? change_ : std::string{};
}

}  // namespace docent::museum
