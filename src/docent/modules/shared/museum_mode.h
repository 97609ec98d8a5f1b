#pragma once

#include <optional>
#include <string>

#include "docent/messages/calibration_messages.h"
#include "docent/messages/operation_messages.h"
#include "docent/modules/shared/module.h"
#include "docent/museum/day_plan.h"
#include "docent/vocabulary/vocabulary.h"

namespace docent::modules {

/// Which mode of the museum holds, and what follows from it. What the operator says on docent/limits counts; where they
/// say the mode `hours`, and as long as they say nothing, the museum's hours decide by the clock on the wall.
class MuseumMode {
 public:
  /// The museum outlives it.
  explicit MuseumMode(const ModuleContext& context)
      : museum_{context.museum}, clock_{context.virtual_time, context.day_begins, context.clocks} {}

  void limits(const docent_msgs::Limits& limits) { limits_ = limits; }
  /// Until it is known where the scanners are mounted the robot is slow, whatever others allow.
  void calibration(const docent_msgs::Calibration& calibration) { unknown_speed_ = calibration.most_speed; }

  museum::WallClock& clock() { return clock_; }
  [[nodiscard]] const museum::WallClock& clock() const { return clock_; }

  [[nodiscard]] bool is_by_hours() const {
    return !limits_ || parse<OperatingMode>(limits_->mode) == OperatingMode::hours;
  }
  [[nodiscard]] std::string name(Time now) const;  ///< open, web, closed
  /// What the museum's hours say next; nullopt: nothing, or the hours decide nothing now.
  [[nodiscard]] std::optional<museum::NextMode> next(Time now) const {
    return is_by_hours() ? museum::next_mode(museum_, minute_of_day(now)) : std::nullopt;
  }
  [[nodiscard]] bool takes_requests() const { return !limits_ || limits_->is_open; }
  /// [m/s]; nullopt: nobody says one.
  [[nodiscard]] std::optional<double> max_speed(Time now) const;
  [[nodiscard]] int minute_of_day(Time now) const { return clock_.minute_of_day(now); }  ///< 0..1439
  [[nodiscard]] double wait_s(Time now) const;                                           ///< [s] at each exhibit
  /// 0..1: what the operator allows, and less in the museum's quiet hours.
  [[nodiscard]] double volume(Time now) const;

 private:
  [[nodiscard]] const museum::Mode* mode(Time now) const;
  [[nodiscard]] std::optional<double> allowed_speed(Time now) const;

  const museum::Museum& museum_;
  museum::WallClock clock_;
  std::optional<docent_msgs::Limits> limits_;
  double unknown_speed_ = 0.0;  ///< [m/s]; 0: no limit
};

}  // namespace docent::modules
