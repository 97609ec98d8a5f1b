#pragma once

#include <string>
#include <vector>

#include "odd_machine.h"
#include "stop_robot.h"

namespace docent {

/// What became of one hour of the day.
struct StopHour {
  int hour = 0;
  std::string clock;   ///< what was done to the wall's clock at its beginning
  std::string mode;    ///< whose hours it was
  std::string killed;  ///< in this order
  bool is_full = false;
  double acknowledged_s = 0.0;
  double way_m = 0.0;     ///< while it was stopped
  double driven_m = 0.0;  ///< in the whole hour
  std::string fault;
};

/// 24 hours of a museum, each `hour_s` long: the wall's clock is set ahead by what is left out, back and forth, and
/// over the end of daylight saving; processes die and hang, the disk fills, and in each hour the stop is pressed and
/// released.
/// @param from, count  some of its hours
[[nodiscard]] std::vector<StopHour> run_day(StopRobot& robot, OddMachine& machine, double hour_s, unsigned seed,
                                            int from, int count);

/// Seconds since 1970 at the beginning of the night in which daylight saving ends, where the day begins.
inline constexpr std::int64_t kDayBegins = 1'792'879'200;  // 2026-10-25 00:00 in Bonn
/// The zone of the museum, for the environment of all programs.
inline constexpr const char* kZone = "Europe/Berlin";

}  // namespace docent
