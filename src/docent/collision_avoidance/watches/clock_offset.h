#pragma once

#include <optional>

#include "docent/base/time.h"

namespace docent::collision_avoidance {

struct ClockOffsetParams {
  double creep = 0.0005;  ///< [s/s] by which the least delay may grow: more than two quartz clocks drift apart
  double future = 1.0;    ///< [s] a stamp so far before what the clock said so far is not believed at once
  double agree = 0.3;     ///< [s] within which such stamps say the same
  int enough = 3;         ///< messages that agree: the clock was set
};

/// The offset of the clock that stamps a topic (architecture 10.4): the least difference seen between receipt and
/// stamp, which may creep up by half a millisecond a second, for clocks drift. A stamp far in the future is no word of
/// that clock until a few more agree: one wrong message must not make all later ones look old.
class ClockOffset {
 public:
  explicit ClockOffset(const ClockOffsetParams& params = {}) : params_{params} {}

  /// False: the stamp is not believed; the message may be of any age.
  bool receive(Time now, Time stamp);

  /// Least delay [s] from stamp to receipt: the clock's offset, and the shortest way of a message. 0 before the first.
  [[nodiscard]] double least_delay() const { return least_; }
  /// How much longer [s] the newest believed message took.
  [[nodiscard]] double lateness() const { return lateness_; }

 private:
  ClockOffsetParams params_;
  std::optional<Time> received_;
  double least_ = 0.0;
  double lateness_ = 0.0;
  double early_ = 0.0;  ///< [s] delay of the last message from the future
  int early_count_ = 0;
};

}  // namespace docent::collision_avoidance
