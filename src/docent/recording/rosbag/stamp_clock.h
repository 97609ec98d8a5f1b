#pragma once

#include <cstddef>
#include <vector>

#include "docent/base/time.h"

namespace docent::recording {

/// When a message says that it is of, and when it was recorded.
struct RecordedStamp {
  Time stamp;
  Time recorded;
};

/// The stamps of one topic in the order of the file, mended where they are of another clock: a computer that began in
/// 1970 and then asked the network, a clock that jumps, wraps or stands. From one message to the next a stamp goes as
/// far as the time of the file, but for ten seconds; where it does not, the clock was set, and the stamps of the
/// shorter stretches are moved to that of the longest. A stamp that stands while messages go on coming goes on with
/// them. Stamps that go back and forth are of two clocks: they are those of the file, as far before them as most are. A
/// clock that is slower than the file's, as that of a simulation, stays as it is; times of the file that tell nothing
/// (all equal) mend nothing. O(n).
struct MendedStamps {
  std::vector<Time> times;  ///< [messages]
  std::size_t mended = 0;   ///< so many of them
};
[[nodiscard]] MendedStamps mended_stamps(const std::vector<RecordedStamp>& stamps);

/// How far the clock of `stamps` is ahead of that of `others`, in the median: each is set beside what was recorded at
/// its time, for two topics of a clock that is faster or slower than the file's are farther from it the later they are.
/// @pre both in the order of the file's times. Zero where either is empty. O(n log m)
[[nodiscard]] Duration clock_ahead(const std::vector<RecordedStamp>& stamps, const std::vector<RecordedStamp>& others);

}  // namespace docent::recording
