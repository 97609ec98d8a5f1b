#pragma once

#include <limits>
#include <optional>

#include "docent/base/time.h"
#include "docent/collision_avoidance/clocks/clock_offset.h"

namespace docent::collision_avoidance {

struct FreshnessParams {
  double patience = 0.5;       ///< [s] without a message, at least, before what is known is stale
  double stale_periods = 2.5;  ///< after so many without a message something is wrong (safety rule 1)
  double longest_pause = 2.0;  ///< periods; a pause must not teach that pauses are normal
  double first_period = 1.0;   ///< [s] at most, between the first two messages
  double learning = 0.1;       ///< an interval's share in the usual one
  double caution = 3.0;        ///< [s] for which messages of a clock that was set back count as late
};

/// How old the newest message of a topic is, both by local receipt and by stamp (architecture 10.4).
///
/// Stamps may come from another computer's clock: what a message is late beyond the least delay (ClockOffset) counts as
/// age.
class Freshness {
 public:
  explicit Freshness(const FreshnessParams& params = {}) : params_{params}, clock_{of(params)} {}

  void receive(Time now, Time stamp);

  /// Age [s] of what is known: time since receipt plus the lateness of the stamp. Infinite before the first message.
  [[nodiscard]] double age(Time now) const;
  /// Time [s] since the last receipt alone.
  [[nodiscard]] double silence(Time now) const;
  /// Usual time [s] between messages; 0 until two have come.
  [[nodiscard]] double period() const { return period_; }
  /// How much later [s] than the least delay the newest message came, by its stamp.
  [[nodiscard]] double lateness() const { return clock_.lateness(); }
  /// Older than max(patience or `least` [s], some periods): safety rule 1.
  [[nodiscard]] bool is_stale(Time now) const { return is_stale(now, params_.patience); }
  [[nodiscard]] bool is_stale(Time now, double least) const { return age(now) > patience(least); }
  /// The same of the last receipt alone.
  [[nodiscard]] bool is_silent(Time now, double least) const { return silence(now) > patience(least); }

 private:
  static ClockOffsetParams of(const FreshnessParams& params) {
    ClockOffsetParams clock;
    clock.caution = params.caution;
    return clock;
  }
  [[nodiscard]] double patience(double least) const;  ///< [s]

  FreshnessParams params_;
  std::optional<Time> received_;
  ClockOffset clock_;
  double period_ = 0.0;
};

}  // namespace docent::collision_avoidance
