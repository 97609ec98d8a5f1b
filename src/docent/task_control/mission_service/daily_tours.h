#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "docent/museum/day_plan.h"
#include "docent/museum/museum.h"
#include "docent/task_control/tour_scheduler/programme.h"
#include "docent/task_control/tour_scheduler/request_board.h"

namespace docent::task_control {

/// The tours of museum.yaml that begin by themselves every day: shown and spoken of before, and then wished for, once a
/// day each. Deterministic; the clock on the wall comes from outside.
class DailyTours {
 public:
  static constexpr int kShown = 15;  ///< [min] before it begins, people read of it: so long they may wait
  static constexpr int kSpoken = 6;  ///< [min] before, people near by hear of it: so long they will wait
  static constexpr int kLate = 2;    ///< [min] after its time it still begins: the mission was being restarted

  /// The museum outlives it.
  explicit DailyTours(const museum::Museum& museum) : museum_{museum} {}

  struct News {
    std::optional<museum::DailyTour> soon;  ///< what people read of
    std::string language;                   ///< in which it is to be spoken of now; empty: in none
    std::optional<VisitorRequest> begins;   ///< the wish for it; an id a day, so that it is one wish after a restart
  };
  /// Some times a minute. @param minute_of_day  0..1439 @param day  by WallClock
  /// @param is_open  visitors in the hall are served @param may_speak  the robot is not speaking to anybody
  [[nodiscard]] News look(int minute_of_day, std::int64_t day, bool is_open, bool may_speak, Time now);

 private:
  [[nodiscard]] std::optional<museum::DailyTour> due(int minute_of_day) const;
  /// Each language once, a minute apart.
  [[nodiscard]] std::string language_due(const museum::DailyTour& tour, int minute_of_day, std::int64_t day);

  const museum::Museum& museum_;
  std::string begun_;          ///< id of the last wish
  std::string spoken_of_;      ///< likewise of the tour that was spoken of
  std::size_t languages_ = 0;  ///< in which it was
  int spoken_at_ = -1;         ///< minute of the day
};

/// "The highlights, 14:00"
[[nodiscard]] std::string name_and_time(const museum::Museum& museum, const museum::DailyTour& tour,
                                        const std::string& language);

}  // namespace docent::task_control
