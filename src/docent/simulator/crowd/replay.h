#pragma once

#include <cstddef>
#include <vector>

#include "docent/base/random.h"
#include "docent/simulator/pedestrians/track.h"

namespace docent::simulator {

/// One passage of a recorded person through the museum.
struct Walk {
  std::size_t recording = 0;
  std::size_t track = 0;
  double origin = 0.0;  ///< [s], when the recording's time was 0
};

/// Plays recordings again and again, each in a loop of its own that begins at a drawn time.
class Replay {
 public:
  Replay(std::vector<Recording> recordings, Rng rng);

  /// Appends the walks that began since the last call; the first call, those that are under way. @pre now grows [s]
  /// O(new walks)
  void begin(double now, std::vector<Walk>& walks);
  [[nodiscard]] Point2 at(const Walk& walk, double now) const { return track(walk).at(now - walk.origin); }
  [[nodiscard]] bool is_over(const Walk& walk, double now) const { return now - walk.origin > track(walk).end(); }

 private:
  struct Loop {
    std::vector<std::size_t> order;  ///< of tracks, by start
    std::size_t next = 0;            ///< in order
    double origin = 0.0;             ///< [s] of the round that is being played
  };
  [[nodiscard]] const Track& track(const Walk& walk) const { return recordings_[walk.recording].tracks[walk.track]; }

  std::vector<Recording> recordings_;
  std::vector<Loop> loops_;
};

}  // namespace docent::simulator
