#include "docent/telepresence/server/viewer_queue.h"

#include <gtest/gtest.h>

#include <vector>

namespace docent::telepresence {
namespace {

using namespace std::chrono_literals;

SharedText text(const std::string& content) { return std::make_shared<const std::string>(content); }

TEST(TokenBucket, LetsABurstThroughAndThenTheRate) {
  TokenBucket bucket{2.0, 3.0};
  const TokenBucket::Clock::time_point begin{};
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(bucket.take(begin));
  EXPECT_FALSE(bucket.take(begin));
  EXPECT_FALSE(bucket.take(begin + 400ms));
  EXPECT_TRUE(bucket.take(begin + 1000ms));
  int taken = 0;
  for (int i = 0; i < 100; ++i) taken += bucket.take(begin + 1h) ? 1 : 0;
  EXPECT_EQ(taken, 3) << "a long silence saves no more than the burst";
}

TEST(ViewerQueue, AnswersComeFirstThenEachSlotInTurn) {
  ViewerQueue queue{0b1001};
  const auto latest = [](std::size_t slot) { return text("slot " + std::to_string(slot)); };
  EXPECT_TRUE(queue.answer(text("a")));
  EXPECT_EQ(*queue.next(latest), "a");
  EXPECT_EQ(*queue.next(latest), "slot 3");
  EXPECT_FALSE(queue.mark(0b1000)) << "it was sent";
  EXPECT_TRUE(queue.mark(0b1000)) << "a value is skipped";
  EXPECT_EQ(*queue.next(latest), "slot 0") << "the fast slot does not starve the other";
  EXPECT_EQ(*queue.next(latest), "slot 3");
  EXPECT_EQ(queue.next(latest), nullptr);
}

TEST(ViewerQueue, ASlotWithoutAValueIsPassedOver) {
  ViewerQueue queue{0b110};
  const auto latest = [](std::size_t slot) { return slot == 2 ? text("two") : nullptr; };
  EXPECT_EQ(*queue.next(latest), "two");
  EXPECT_EQ(queue.next(latest), nullptr);
}

TEST(ViewerQueue, UnreadAnswersAreBounded) {
  ViewerQueue queue;
  for (std::size_t i = 0; i < ViewerQueue::kMaxAnswers; ++i) EXPECT_TRUE(queue.answer(text("a")));
  EXPECT_FALSE(queue.answer(text("one too many")));
}

}  // namespace
}  // namespace docent::telepresence
