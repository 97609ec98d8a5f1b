#pragma once

#include <deque>

#include "docent/base/time.h"

namespace docent::collision_avoidance {

struct MessageRhythmParams {
  double window = 5.0;            ///< [s] over which messages are counted
  double many = 0.22;             ///< share of the messages that is missing; one in ten is an ordinary network
  double soon = 1.2;              ///< [s] likewise, to see the worst of it soon
  double many_soon = 0.4;         ///< share of these
  double least = 2.0;             ///< [s] that must have been heard before a rhythm is known
  double forgets = 600.0;         ///< [s] in which it gets used to a slower rhythm
  double begins_anew = 0.25;      ///< [s] a stamp so much older than the newest: the clock was set back
  double longest_silence = 10.0;  ///< [s] after which nothing is known of what was before
};

/// How many of the messages that its rhythm foretells a topic misses, counted against their stamps over some seconds:
/// jitter, and bursts of messages that were held, are in a window as a whole or nearly so. Single gaps say nothing.
///
/// The rhythm is the quickest that was kept over the window, by the slower of its halves: a burst at the window's
/// beginning, of messages of before, is in one of them only.
class MessageRhythm {
 public:
  explicit MessageRhythm(const MessageRhythmParams& params = {}) : params_{params} {}

  /// A message came, perhaps out of order; doubles do not count. O(log n)
  void receive(Time stamp);
  [[nodiscard]] bool misses_many() const {
    return missing(params_.window) > params_.many || missing(params_.soon) > params_.many_soon;
  }
  /// Share of the messages of the last `within` [s] before the newest; 0 as long as no rhythm is known.
  [[nodiscard]] double missing(double within) const;
  [[nodiscard]] double period() const { return period_; }  ///< [s] 0: not known yet

 private:
  void learn();
  [[nodiscard]] double since(Time time) const;  ///< messages later than `time`

  MessageRhythmParams params_;
  std::deque<Time> stamps_;  ///< rising, over one window
  Time learnt_{};
  double period_ = 0.0;
};

}  // namespace docent::collision_avoidance
