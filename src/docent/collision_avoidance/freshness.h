#pragma once

#include <limits>
#include <optional>

#include "docent/base/time.h"

namespace docent {

/// How old the newest message of a topic is, both by local receipt and by stamp (architecture 10.4).
///
/// Stamps may come from another computer's clock. The least difference seen between receipt and stamp, which may creep
/// up by half a millisecond a second, is taken as the offset of that clock; what a message is late beyond it counts as
/// age. A stamp far in the future is no word of that clock until a few more agree: one wrong message must not make all
/// later ones look old.
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
  [[nodiscard]] double lateness() const { return lateness_; }
  /// Older than max(`least`, 2.5 periods) [s]: safety rule 1.
  [[nodiscard]] bool is_stale(Time now, double least = 0.5) const;

 private:
  std::optional<Time> received_;
  double offset_ = 0.0;    ///< [s] receipt minus stamp, at its least
  double lateness_ = 0.0;  ///< [s] of the newest message
  double period_ = 0.0;
  double early_ = 0.0;  ///< [s] delay of the last message from the future
  int early_count_ = 0;
};

}  // namespace docent
