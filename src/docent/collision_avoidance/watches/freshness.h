#pragma once

#include <limits>
#include <optional>

#include "docent/base/time.h"
#include "docent/collision_avoidance/watches/clock_offset.h"

namespace docent {

/// How old the newest message of a topic is, both by local receipt and by stamp (architecture 10.4).
///
/// Stamps may come from another computer's clock: what a message is late beyond the least delay (ClockOffset) counts as
/// age.
class Freshness {
 public:
  void receive(Time now, Time stamp);

  /// Age [s] of what is known: time since receipt plus the lateness of the stamp. Infinite before the first message.
  [[nodiscard]] double age(Time now) const;
  /// Time [s] since the last receipt alone.
  [[nodiscard]] double silence(Time now) const;
  /// Usual time [s] between messages; 0 until two have come.
  [[nodiscard]] double period() const { return period_; }
  /// How much later [s] than the least delay the newest message came, by its stamp.
  [[nodiscard]] double lateness() const { return clock_.lateness(); }
  /// Older than max(`least`, 2.5 periods) [s]: safety rule 1.
  [[nodiscard]] bool is_stale(Time now, double least = 0.5) const;

 private:
  std::optional<Time> received_;
  ClockOffset clock_;
  double period_ = 0.0;
};

}  // namespace docent
