#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/task_control/travel_times/travel_times.h"

namespace docent::task_control {

/// How much the robot is wanted at each hour of the day: the share of the time in which somebody waits or is served,
/// 0..1, learned from the days before and from today. Where an hour was never seen, the others speak for it.
/// Deterministic.
class HourlyDemand {
 public:
  static constexpr double kPrior = 0.5;        ///< of an hour of which nothing is known
  static constexpr double kPriorHours = 0.25;  ///< [h] that this counts for
  static constexpr double kOthersHours = 0.5;  ///< [h] that what is known of all other hours counts for
  static constexpr double kMemoryHours = 5.0;  ///< [h] of one hour of the day that count: a week of opening days

  /// Experience from before, as `rows` gave it; rows of other kinds are left out.
  void restore(std::span<const LessonRow> rows);
  /// Once or twice a second. @param hour  of the day, 0..23
  void observe(int hour, bool is_wanted, Time now);
  [[nodiscard]] double share(int hour) const;
  /// Rows that have changed since the last `mark_stored`.
  [[nodiscard]] std::vector<LessonRow> unstored() const;
  void mark_stored() { unstored_.fill(false); }

 private:
  struct Hour {
    double seen = 0.0;    ///< [h]
    double wanted = 0.0;  ///< [h]
    double told = 0.0;    ///< [h] of `seen` when it was last given out
  };
  std::array<Hour, 24> hours_{};
  std::array<bool, 24> unstored_{};
  std::optional<Time> observed_;
};

}  // namespace docent::task_control
