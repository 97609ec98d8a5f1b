#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "docent/base/time.h"

namespace docent::collision_avoidance {

struct ClockOffsetParams {
  double creep = 0.0005;  ///< [s/s] by which the least delay may grow: more than two quartz clocks drift apart
  double future = 0.25;   ///< [s] a stamp so far before what the clock said so far is not believed at once
  double agree = 0.3;     ///< [s] within which such stamps say the same
  int enough = 3;         ///< messages that agree: the clock was set
  double step = 0.02;     ///< [s] a clock that is set back by less is not told from one that is not
  double pause = 2.0;     ///< usual intervals; who comes later for good has been silent for as long once
  int bear_out = 5;       ///< messages without a pause that bear out that the clock was set back
  double caution = 0.0;   ///< [s] for which such messages count as late all the same
};

/// The offset of the clock that stamps a topic (architecture 10.4): the least difference seen between receipt and
/// stamp, which may creep up by half a millisecond a second, for clocks drift. A stamp far in the future is no word of
/// that clock until a few more agree: one wrong message must not make all later ones look old.
///
/// Messages that come later for good and a clock that was set back look alike by their delay alone. But who comes later
/// has been silent for as long, once, and its stamps go on rising; after a clock was set back a stamp is older than the
/// one before, and there is no pause. A lone one that was overtaken is followed by others that come as quickly as ever.
class ClockOffset {
 public:
  explicit ClockOffset(const ClockOffsetParams& params = {}) : params_{params} {}

  /// False: the stamp is not believed; the message may be of any age.
  bool receive(Time now, Time stamp);

  /// Least delay [s] from stamp to receipt: the clock's offset, and the shortest way of a message. 0 before the first.
  [[nodiscard]] double least_delay() const { return least_; }
  /// How much longer [s] the newest believed message took.
  [[nodiscard]] double lateness() const { return lateness_; }
  /// [s] by which the clock was set back since the first message and not forward again: part of the least delay.
  [[nodiscard]] double set_back() const { return set_back_; }

 private:
  /// @param interval  [s] since the last receipt
  void watch_for_set_back(double interval, Time stamp, double delay);

  ClockOffsetParams params_;
  std::optional<Time> received_;
  double least_ = 0.0;
  double lateness_ = 0.0;
  double early_ = 0.0;  ///< [s] delay of the last message from the future
  int early_count_ = 0;
  Time newest_{};          ///< stamp
  double interval_ = 0.0;  ///< [s] usual between two receipts
  double set_back_ = 0.0;
  static constexpr std::size_t kLately = 5;
  std::array<double, kLately> delays_{};  ///< [s] the last ones, in turn
  std::size_t turn_ = 0;
  struct Suspicion {
    double before = 0.0;  ///< [s] least delay just before
    double rise = 0.0;    ///< [s] of the delay, when the stamp went back
    double least = 0.0;   ///< [s] delay since
    int count = 0;        ///< messages since, without a pause
    double lasts = 0.0;   ///< [s] since the first of them
  };
  std::optional<Suspicion> suspicion_;
};

}  // namespace docent::collision_avoidance
