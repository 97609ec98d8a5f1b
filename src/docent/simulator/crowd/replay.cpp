#include "docent/simulator/crowd/replay.h"

#include <algorithm>
#include <numeric>

namespace docent::simulator {

Replay::Replay(std::vector<Recording> recordings, Rng rng) : recordings_{std::move(recordings)} {
  for (const Recording& recording : recordings_) {
    Loop loop;
    loop.order.resize(recording.tracks.size());
    std::iota(loop.order.begin(), loop.order.end(), std::size_t{0});
    std::stable_sort(loop.order.begin(), loop.order.end(), [&](std::size_t a, std::size_t b) {
      return recording.tracks[a].start < recording.tracks[b].start;
    });
    loop.origin = -rng.uniform(0.0, recording.duration);
    loops_.push_back(std::move(loop));
  }
}

void Replay::begin(double now, std::vector<Walk>& walks) {
  for (std::size_t i = 0; i < loops_.size(); ++i) {
    Loop& loop = loops_[i];
    const Recording& recording = recordings_[i];
    if (loop.order.empty()) continue;
    while (loop.origin + recording.tracks[loop.order[loop.next]].start <= now) {
      const Walk walk{i, loop.order[loop.next], loop.origin};
      if (!is_over(walk, now)) walks.push_back(walk);
      if (++loop.next < loop.order.size()) continue;
      loop.next = 0;
      loop.origin += recording.duration;
    }
  }
}

}  // namespace docent::simulator
