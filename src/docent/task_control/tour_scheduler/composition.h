#pragma once

#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/task_control/tour_scheduler/programme.h"

namespace docent::task_control {

/// Section `mission` of robot.yaml holds these, too.
struct SchedulerParams {
  int max_stops = 80;           ///< different things wished for at once, >= 1; Bonn has 50 places to stop at
  int max_open = 500;           ///< open requests, >= 1: each change of the board is sent with all of them
  double overdue_s = 600.0;     ///< [s] > 0: who waited longer comes first
  double hurry_after_s = 120;   ///< [s] > 0: while somebody has waited longer, exhibits are shown in the short version
  int max_attempts = 5;         ///< visits tried for a request, >= 1
  double retry_delay_s = 45.0;  ///< [s] >= 0 until the second one; each wait is twice as long as the one before
  double retry_most_s = 240.0;  ///< [s] >= retry_delay_s: but never longer
  int max_stop_attempts = 3;    ///< visits tried for a stop of a tour, >= 1
  double max_detour_m = 4.0;    ///< [m] >= 0: what a tour goes out of its way for a single exhibit
  double cruise_speed = 0.35;   ///< [m/s] > 0: for composing tours; people in the way included
  double stop_overhead_s = 15;  ///< [s] >= 0: turning and asking at each exhibit, for composing tours
  int max_skipped = 1;          ///< exhibits that a fulfilled tour may have left out, >= 0
  template <class V>
  void visit(V& v) {
    v("max_stops", max_stops);
    v("max_open", max_open);
    v("overdue_s", overdue_s);
    v("hurry_after_s", hurry_after_s);
    v("max_attempts", max_attempts);
    v("retry_delay_s", retry_delay_s);
    v("retry_most_s", retry_most_s);
    v("max_stop_attempts", max_stop_attempts);
    v("max_detour_m", max_detour_m);
    v("cruise_speed", cruise_speed);
    v("stop_overhead_s", stop_overhead_s);
    v("max_skipped", max_skipped);
  }
  [[nodiscard]] Result<void> validate() const;
  /// [s] before a request is tried again of which so many visits failed. @pre attempts >= 1
  [[nodiscard]] double retry_after(int attempts) const;
};

/// How long it takes to go to an exhibit and show it, in the short version [s].
[[nodiscard]] double stop_duration(const ProgrammeExhibit& exhibit, double way_m, const SchedulerParams& params);

/// What a composed tour may show.
struct StopChoice {
  std::vector<std::string> done;    ///< left out
  std::vector<std::string> wished;  ///< others wait for these: they count as nearer, by kWishedFactor
  std::string after{};              ///< shown last: what makes sense after it counts as nearer, by kSensibleFactor
};
inline constexpr double kWishedFactor = 0.2;
inline constexpr double kSensibleFactor = 0.5;

/// Exhibits for the `left_s` that remain of a composed tour, from where the robot stands: always the nearest one, as
/// long as less than half of it lies beyond the end, so that the length comes out right on average. What makes sense
/// after the exhibit before counts as nearer. Those that only Web visitors may see are left out. O(exhibits^2).
[[nodiscard]] std::vector<std::string> compose_tour(const Programme& programme, Point2 start, double left_s,
                                                    const StopChoice& choice, const TravelDistance& travel,
                                                    const SchedulerParams& params);

}  // namespace docent::task_control
