#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "docent/base/time.h"

namespace docent::museum {

/// The clocks of the computer; tests give others.
struct Clocks {
  /// Since 1970, as it is set.
  std::function<Duration()> wall = [] {
    return std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch());
  };
  /// Since some time, never set.
  std::function<Duration()> steady = [] {
    return std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch());
  };
};

/// The clock on the wall of the building. Opening hours follow it wherever it is set, forth and back and over daylight
/// saving: the time of the bus never steps back, and so is none. All modules ask the computer, and agree. In virtual
/// time it is `day_begins` and what has passed since.
class WallClock {
 public:
  /// @param day_begins  the time of day at which virtual time begins
  WallClock(bool is_virtual, Duration day_begins, Clocks clocks)
      : is_virtual_{is_virtual}, day_begins_{day_begins}, clocks_{std::move(clocks)} {}

  /// @param now  of the bus, which counts in virtual time alone
  /// @returns 0..1439
  [[nodiscard]] int minute_of_day(Time now) const;
  /// A number that another day does not have; two days on it are two days apart but for leap years.
  [[nodiscard]] std::int64_t day(Time now) const;
  /// Looks whether it was set since the last look; a second or so apart.
  void look();
  /// "the clock was set back by 61 min 10 s at 09:26", for ten minutes after; empty: it was not.
  [[nodiscard]] std::string change() const;

 private:
  bool is_virtual_;
  Duration day_begins_;
  Clocks clocks_;
  std::optional<Duration> apart_;  ///< of the wall's clock and the steady one, at the last look
  Duration changed_at_{};          ///< by the steady one
  std::string change_;
};

}  // namespace docent::museum
