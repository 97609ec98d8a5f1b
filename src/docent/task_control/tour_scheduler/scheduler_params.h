#pragma once

#include "docent/base/result.h"
#include "docent/task_control/tour_scheduler/composition.h"
#include "docent/task_control/travel_times/travel_times.h"

namespace docent::task_control {

/// Section `mission` of robot.yaml holds these, too.
struct SchedulerParams {
  int max_stops = 80;        ///< different things wished for at once, >= 1; Bonn has 50 places to stop at
  int max_open = 500;        ///< open requests, >= 1: each change of the board is sent with all of them
  int max_points = 5;        ///< points on the map wished for at once, >= 1 ([Minerva2000] 6.4)
  double overdue_s = 600.0;  ///< [s] > 0: who waited longer comes first,
  /// [s] >= 0: but nobody is overdue before so much, twice what a visit takes, for each of the most stops that were
  /// wished for at once while they waited: where many wait, all wait for long, and the order of the least travel serves
  /// them soonest.
  double overdue_per_stop_s = 120.0;
  double hurry_after_s = 120;   ///< [s] > 0: while somebody has waited longer, exhibits are shown in the short version
  int max_attempts = 5;         ///< visits tried for a request, >= 1
  double retry_delay_s = 45.0;  ///< [s] >= 0 until the second one; each wait is twice as long as the one before
  double retry_most_s = 240.0;  ///< [s] >= retry_delay_s: but never longer
  int max_stop_attempts = 3;    ///< visits tried for a stop of a tour, >= 1
  double max_detour_m = 4.0;    ///< [m] >= 0: what a tour with a fixed order goes out of its way for a single exhibit
  int max_skipped = 1;          ///< exhibits that a fulfilled tour may have left out, >= 0
  /// [s] >= 0: a tour that was broken off is let go when nobody is near after so long
  double wait_for_group_s = 120.0;
  bool offer_more = true;  ///< ask at each exhibit, unless others wait for long: more, or next?
  bool by_travel = true;   ///< false: crippled, for evaluation: single exhibits in the order in which they came
  TravelTimeParams travel_times;
  CompositionParams composition;
  template <class V>
  void visit(V& v) {
    v("max_stops", max_stops);
    v("max_open", max_open);
    v("max_points", max_points);
    v("overdue_s", overdue_s);
    v("overdue_per_stop_s", overdue_per_stop_s);
    v("hurry_after_s", hurry_after_s);
    v("max_attempts", max_attempts);
    v("retry_delay_s", retry_delay_s);
    v("retry_most_s", retry_most_s);
    v("max_stop_attempts", max_stop_attempts);
    v("max_detour_m", max_detour_m);
    v("max_skipped", max_skipped);
    v("wait_for_group_s", wait_for_group_s);
    v("offer_more", offer_more);
    v("travel_times", travel_times);
    v("composition", composition);
  }
  [[nodiscard]] Result<void> validate() const;
  /// [s] before a request is tried again of which so many visits failed. @pre attempts >= 1
  [[nodiscard]] double retry_after(int attempts) const;
};

}  // namespace docent::task_control
