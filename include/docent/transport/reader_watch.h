#pragma once

#include <chrono>

namespace docent::transport {

/// What tells a reader that is deaf from a sensor that is silent.
struct ReaderWatchParams {
  int regular = 20;       ///< messages that tell how often they come
  double periods = 20.0;  ///< without a message, and
  double least = 2.0;     ///< [s] at least, while their writer lives: the reader is deaf
  double most = 60.0;     ///< [s] between two tries at most; each waits twice as long as the one before
  double learning = 0.1;  ///< an interval's share in the usual one
};

/// Whether a reader has gone deaf: its messages came regularly, their writer shows life, and nothing comes any more.
/// Seen where processes that read the same topics were killed and came back on a busy computer: the others heard the
/// scans, one did not for as long as it ran. A new reader hears.
class ReaderWatch {
 public:
  using Clock = std::chrono::steady_clock;  ///< which nobody sets
  /// Of one reader.
  explicit ReaderWatch(const ReaderWatchParams& params = {}) : params_{params} {}

  void hear(Clock::time_point at);  ///< a message came
  /// True where a new reader should be made now. @param lives  whether a writer of the topic shows life
  [[nodiscard]] bool is_deaf(Clock::time_point at, bool lives);

 private:
  ReaderWatchParams params_;
  int count_ = 0;
  Clock::time_point heard_;
  double period_ = 0.0;  ///< [s] usual
  double wait_ = 0.0;    ///< [s] of silence until the next try; 0: not silent
};

}  // namespace docent::transport
