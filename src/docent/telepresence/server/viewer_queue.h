#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace docent::telepresence {

/// Encoded once, sent to many.
using SharedText = std::shared_ptr<const std::string>;

/// Lets `burst` messages through at once and `rate` a second in the long run.
class TokenBucket {
 public:
  using Clock = std::chrono::steady_clock;
  TokenBucket(double rate, double burst) : rate_{rate}, burst_{burst}, tokens_{burst} {}
  bool take(Clock::time_point now) {
    if (last_) tokens_ = std::min(burst_, tokens_ + rate_ * std::chrono::duration<double>(now - *last_).count());
    last_ = now;
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  double rate_, burst_, tokens_;
  std::optional<Clock::time_point> last_;
};

/// What one viewer has still to get: answers in their order, and which slots have a newer value. It is bounded: a slot
/// is new or not, and answers beyond kMaxAnswers are not taken.
class ViewerQueue {
 public:
  static constexpr std::size_t kMaxAnswers = 64;

  /// @param slots  a bit for each that has a value
  explicit ViewerQueue(std::uint32_t slots = 0) : stale_{slots} {}

  /// The slots have new values; true when one of them was not yet sent.
  bool mark(std::uint32_t slots) {
    const bool skips = (stale_ & slots) != 0;
    stale_ |= slots;
    return skips;
  }
  /// False: too many are unread.
  bool answer(SharedText text) {
    if (answers_.size() >= kMaxAnswers) return false;
    answers_.push_back(std::move(text));
    return true;
  }
  /// The next thing to send: an answer, or what `latest(slot)` gives for a slot that is new; null: nothing.
  template <class Latest>
  [[nodiscard]] SharedText next(const Latest& latest) {
    if (!answers_.empty()) {
      SharedText text = std::move(answers_.front());
      answers_.pop_front();
      return text;
    }
    while (stale_ != 0) {
      // Round robin, so that a fast slot does not starve the others.
      do next_slot_ = (next_slot_ + 1) % kBits;
      while ((stale_ & (1U << next_slot_)) == 0);
      stale_ &= ~(1U << next_slot_);
      if (SharedText text = latest(next_slot_)) return text;
    }
    return nullptr;
  }

 private:
  static constexpr std::size_t kBits = 32;
  std::deque<SharedText> answers_;
  std::uint32_t stale_ = 0;
  std::size_t next_slot_ = 0;
};

}  // namespace docent::telepresence
