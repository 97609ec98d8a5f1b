#include "docent/messages/scanners/zero_meaning.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace docent {
namespace {

constexpr double kNearZero = 0.6;          // [m] a zero beside a nearer reading may be something that is too near
constexpr double kAtReach = 0.75;          // of the greatest range: beyond, walls run out of reach
constexpr std::size_t kEdgesAtReach = 3;   // of zeros at the reach in one sweep, in
constexpr std::size_t kSweepsAtReach = 5;  // so many sweeps
constexpr std::size_t kSaidFar = 20;       // readings that say "nothing there" in another way
constexpr double kWanderedShare = 0.08;    // of the beams, that edges have passed over
constexpr std::size_t kWandered = 12;      // and so many at least
constexpr double kWanders = std::numbers::pi / 6.0;  // [rad] farther no edge wanders from sweep to sweep
constexpr double kOpenShare = 0.8;                   // of the beams of zeros, that stand beside something far

}  // namespace

void ZeroMeaning::add(std::span<const float> ranges, double bearing_step, double min_range, double max_range) {
  if (found_ != ZeroMeans::find_out || ranges.empty()) return;
  if (before_.size() != ranges.size()) {
    before_.clear();
    wandered_.assign(ranges.size(), false);
  }
  now_.resize(ranges.size());
  const double near = std::max(kNearZero, 3.0 * min_range);
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double range = static_cast<double>(ranges[i]);
    now_[i] = range == 0.0                                   ? Beam::zero
              : std::isnan(range) || range < min_range       ? Beam::none
              : range < std::min(near, kAtReach * max_range) ? Beam::near
                                                             : Beam::open;
    if (range < max_range) continue;
    far_ += range == said_far_ ? 1 : 0;  // a word is always the same, a reading from beyond the greatest range is not
    said_far_ = range;
  }
  if (far_ >= kSaidFar) {
    found_ = ZeroMeans::failed;
    return;
  }
  note_edges_at_reach(ranges, max_range);
  if (!before_.empty()) note_edges_that_wander(bearing_step);
  std::swap(now_, before_);
  const auto wandered = static_cast<std::size_t>(std::count(wandered_.begin(), wandered_.end(), true));
  const auto enough =
      std::max(kWandered, static_cast<std::size_t>(kWanderedShare * static_cast<double>(ranges.size())));
  const bool is_open = static_cast<double>(open_) >= kOpenShare * static_cast<double>(open_ + closed_);
  if (is_open && (at_reach_ >= kSweepsAtReach || wandered >= enough)) found_ = ZeroMeans::nothing;
}

void ZeroMeaning::note_edges_at_reach(std::span<const float> ranges, double max_range) {
  std::size_t at_reach = 0;
  for (std::size_t begin = 0; begin < now_.size();) {
    std::size_t end = begin + 1;
    if (now_[begin] == Beam::zero) {
      while (end < now_.size() && now_[end] == Beam::zero) ++end;
      bool is_near = false, is_open = false;
      const auto ask = [&](std::size_t beside) {
        is_near = is_near || now_[beside] == Beam::near;
        is_open = is_open || now_[beside] == Beam::open;
        at_reach += now_[beside] == Beam::open && static_cast<double>(ranges[beside]) >= kAtReach * max_range ? 1 : 0;
      };
      if (begin > 0) ask(begin - 1);
      if (end < now_.size()) ask(end);
      if (is_near) {
        closed_ += end - begin;
      } else if (is_open) {
        open_ += end - begin;
      }
    }
    begin = end;
  }
  at_reach_ += at_reach >= kEdgesAtReach ? 1 : 0;
}

void ZeroMeaning::note_edges_that_wander(double bearing_step) {
  const auto most = static_cast<std::size_t>(std::max(1.0, kWanders / bearing_step));
  const auto has_flipped = [&](std::size_t i) {
    return (now_[i] == Beam::zero && before_[i] == Beam::open) || (now_[i] == Beam::open && before_[i] == Beam::zero);
  };
  for (std::size_t begin = 0; begin < now_.size();) {
    std::size_t end = begin + 1;
    if (has_flipped(begin)) {
      while (end < now_.size() && has_flipped(end) && now_[end] == now_[begin]) ++end;
      // At the edge of what was, or is, without an answer as well: nothing that comes or goes as a whole.
      const auto is_zero_twice = [&](std::size_t i) { return now_[i] == Beam::zero && before_[i] == Beam::zero; };
      const bool is_edge = (begin > 0 && is_zero_twice(begin - 1)) || (end < now_.size() && is_zero_twice(end));
      if (is_edge && end - begin <= most)
        std::fill(wandered_.begin() + static_cast<std::ptrdiff_t>(begin),
                  wandered_.begin() + static_cast<std::ptrdiff_t>(end), true);
    }
    begin = end;
  }
}

}  // namespace docent
