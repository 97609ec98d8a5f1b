#include "docent/recording/rosbag/stamp_clock.h"

#include <algorithm>
#include <chrono>

namespace docent::recording {
namespace {

constexpr Duration kSet = std::chrono::seconds{10};  ///< no line and no disk is so slow
constexpr std::size_t kStands = 5;                   ///< equal stamps in succession
constexpr Duration kStandsFor =
    std::chrono::milliseconds{200};  ///< of the file's time from the first to the last of them

Duration size_of(Duration duration) { return duration < Duration{} ? -duration : duration; }

/// Lets stamps that stand go on with the times of the file; how many those are.
std::size_t let_go_on(std::vector<Time>& times, const std::vector<RecordedStamp>& stamps) {
  std::size_t moved = 0;
  for (std::size_t from = 0, to = 0; from < stamps.size(); from = to) {
    for (to = from; to < stamps.size() && stamps[to].stamp == stamps[from].stamp;) ++to;
    if (to - from < kStands || stamps[to - 1].recorded - stamps[from].recorded < kStandsFor) continue;
    for (std::size_t i = from; i < to; ++i)
      times[i] = stamps[from].stamp + (stamps[i].recorded - stamps[from].recorded);
    moved += to - from - 1;
  }
  return moved;
}

}  // namespace

MendedStamps mended_stamps(const std::vector<RecordedStamp>& stamps) {
  MendedStamps mended;
  mended.times.reserve(stamps.size());
  for (const RecordedStamp& one : stamps) mended.times.push_back(one.stamp);
  const auto by_file = [](const RecordedStamp& a, const RecordedStamp& b) { return a.recorded < b.recorded; };
  const auto [first, last] = std::minmax_element(stamps.begin(), stamps.end(), by_file);
  if (stamps.empty() || first->recorded == last->recorded) return mended;
  mended.mended = let_go_on(mended.times, stamps);
  // Stretches between which the clock was set: how far each has to be moved to follow the first.
  std::vector<Duration> shift(stamps.size());
  std::vector<std::size_t> begins{0};
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    const Duration set = (mended.times[i] - mended.times[i - 1]) - (stamps[i].recorded - stamps[i - 1].recorded);
    const bool was_set = size_of(set) > kSet;
    shift[i] = shift[i - 1] - (was_set ? set : Duration{});
    if (was_set) begins.push_back(i);
  }
  begins.push_back(stamps.size());
  std::size_t longest = 0;
  for (std::size_t k = 0; k + 1 < begins.size(); ++k)
    if (begins[k + 1] - begins[k] > begins[longest + 1] - begins[longest]) longest = k;
  const Duration right = shift[begins[longest]];
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    mended.times[i] = mended.times[i] + (shift[i] - right);
    mended.mended += shift[i] != right ? 1 : 0;
  }
  return mended;
}

}  // namespace docent::recording
