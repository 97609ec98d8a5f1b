#pragma once

#include <cstddef>
#include <vector>

#include "docent/base/time.h"

namespace docent::localization {

/// When to look at what the lasers have seen: at once when the scan has come that makes the round whole. A round is one
/// scan of every laser, or a second one of the same laser: then the others are slower, late or dead. So a look never
/// waits for a clock, and what it sees is as young as the way of the newest scan.
class ScanRounds {
 public:
  /// From one look to the next, at least: of lasers that are faster the newest scans count.
  static constexpr Duration kLeastPause = std::chrono::milliseconds{60};

  explicit ScanRounds(std::size_t lasers) : has_new_(lasers) {}

  /// A scan of one of them came.
  void hear(std::size_t laser, Time now);
  /// Since when a whole round waits to be looked at; none: nothing is due.
  [[nodiscard]] bool is_whole() const { return is_whole_; }
  [[nodiscard]] Time whole_since() const { return whole_since_; }  ///< @pre is_whole
  /// All that came is looked at.
  void close(Time now);

 private:
  std::vector<bool> has_new_;  ///< [lasers] in this round
  bool is_whole_ = false;
  bool was_closed_ = false;
  Time whole_since_{};
  Time closed_{};
};

}  // namespace docent::localization
