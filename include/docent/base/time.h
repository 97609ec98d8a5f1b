#pragma once

#include <chrono>
#include <cmath>
#include <compare>
#include <cstdint>

namespace docent {

using Duration = std::chrono::nanoseconds;  ///< a span of time

/// Rounded to nanoseconds.
[[nodiscard]] inline Duration seconds(double value) {
  return Duration{static_cast<std::int64_t>(std::llround(value * 1e9))};
}
[[nodiscard]] inline double to_seconds(Duration value) { return static_cast<double>(value.count()) * 1e-9; }  ///< [s]

/// A point in time of the bus's clock: wall time since 1970 under DDS, time since the start in virtual time.
struct Time {
  std::int64_t nanoseconds = 0;  ///< since the clock's start

  friend constexpr auto operator<=>(const Time&, const Time&) = default;  ///< earlier is less
  /// So much later.
  friend constexpr Time operator+(Time time, Duration duration) { return {time.nanoseconds + duration.count()}; }
  /// So much earlier.
  friend constexpr Time operator-(Time time, Duration duration) { return {time.nanoseconds - duration.count()}; }
  /// From b to a.
  friend constexpr Duration operator-(Time a, Time b) { return Duration{a.nanoseconds - b.nanoseconds}; }
};

[[nodiscard]] inline Time time_from_seconds(double value) { return Time{seconds(value).count()}; }          ///< [s]
[[nodiscard]] inline double to_seconds(Time time) { return static_cast<double>(time.nanoseconds) * 1e-9; }  ///< [s]

}  // namespace docent
