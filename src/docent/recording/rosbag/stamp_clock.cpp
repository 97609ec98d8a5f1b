#include "docent/recording/rosbag/stamp_clock.h"

#include <algorithm>
#include <chrono>
#include <iterator>

namespace docent::recording {
namespace {

constexpr Duration kSet = std::chrono::seconds{10};  ///< no line and no disk is so slow
constexpr std::size_t kStands = 5;                   ///< equal stamps in succession
constexpr Duration kStandsFor =
    std::chrono::milliseconds{200};  ///< of the file's time from the first to the last of them

constexpr Duration kTwoClocks = std::chrono::milliseconds{500};  ///< of one stamp before the next
constexpr std::size_t kFewestFalls = 3;
constexpr double kShareOfFalls = 0.02;  ///< of the messages

Duration size_of(Duration duration) { return duration < Duration{} ? -duration : duration; }

/// Lets stamps that stand go on with the times of the file; how many those are.
std::size_t let_go_on(std::vector<Time>& times, const std::vector<RecordedStamp>& stamps) {
  std::size_t moved = 0;
  for (std::size_t from = 0, to = 0; from < stamps.size(); from = to) {
    for (to = from; to < stamps.size() && stamps[to].stamp == stamps[from].stamp;) ++to;
    if (to - from < kStands || stamps[to - 1].recorded - stamps[from].recorded < kStandsFor) continue;
    // The first that stands may be late already: what came before tells how far the clock was.
    const std::size_t before = from > 0 ? from - 1 : from;
    const Time right = times[before];
    for (std::size_t i = from; i < to; ++i) times[i] = right + (stamps[i].recorded - stamps[before].recorded);
    moved += to - from - 1;
  }
  return moved;
}

/// Where stamps go back and forth, which those of one clock do not. How many are moved.
std::size_t part_two_clocks(std::vector<Time>& times, const std::vector<RecordedStamp>& stamps) {
  std::size_t falls = 0;
  for (std::size_t i = 1; i < times.size(); ++i) falls += times[i - 1] - times[i] > kTwoClocks ? 1 : 0;
  if (falls < kFewestFalls || static_cast<double>(falls) < kShareOfFalls * static_cast<double>(times.size())) return 0;
  std::vector<Duration> ahead;
  for (std::size_t i = 0; i < times.size(); ++i) ahead.push_back(times[i] - stamps[i].recorded);
  std::sort(ahead.begin(), ahead.end());
  const Duration most = ahead[ahead.size() / 2];
  std::size_t moved = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Duration off = times[i] - stamps[i].recorded - most;
    if (size_of(off) <= kTwoClocks) continue;
    times[i] = stamps[i].recorded + most;
    ++moved;
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
  if (const std::size_t moved = part_two_clocks(mended.times, stamps); moved > 0) mended.mended = moved;
  return mended;
}

Duration clock_ahead(const std::vector<RecordedStamp>& stamps, const std::vector<RecordedStamp>& others) {
  if (stamps.empty() || others.empty()) return {};
  std::vector<Duration> ahead;
  ahead.reserve(stamps.size());
  for (const RecordedStamp& one : stamps) {
    const auto [from, to] =
        std::equal_range(others.begin(), others.end(), one,
                         [](const RecordedStamp& a, const RecordedStamp& b) { return a.recorded < b.recorded; });
    // Of several that were recorded at once, or all where the file has no times, the middle one.
    const auto at = std::min((from - others.begin() + (to - others.begin())) / 2, std::ssize(others) - 1);
    const RecordedStamp& other = others[static_cast<std::size_t>(at)];
    ahead.push_back((one.stamp - one.recorded) - (other.stamp - other.recorded));
  }
  const auto middle = ahead.begin() + std::ssize(ahead) / 2;
  std::nth_element(ahead.begin(), middle, ahead.end());
  return *middle;
}

}  // namespace docent::recording
