#include "docent/telepresence/api/worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

namespace docent::telepresence {
namespace {

TEST(AWorker, DoesAllInOrderAndNoMoreThanItsBoundWaits) {
  std::vector<int> done;
  std::promise<void> gate, has_begun;
  {
    Worker worker{3};
    ASSERT_TRUE(worker.post([&] {
      has_begun.set_value();
      gate.get_future().wait();
    }));
    has_begun.get_future().wait();
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(worker.post([&done, i] { done.push_back(i); }));
    EXPECT_FALSE(worker.post([&done] { done.push_back(99); }));
    gate.set_value();
  }
  EXPECT_EQ(done, (std::vector{0, 1, 2})) << "also what waited when it ended";
}

TEST(AWorker, HearsTheSmallestRankFirstWhichTakesThePlaceOfTheLargest) {
  std::vector<std::string> heard;
  std::promise<void> gate, has_begun;
  {
    Worker worker{3};
    const auto say = [&](const char* name) { return [&heard, name] { heard.emplace_back(name); }; };
    ASSERT_TRUE(worker.post([&] {
      has_begun.set_value();
      gate.get_future().wait();
    }));
    has_begun.get_future().wait();
    EXPECT_TRUE(worker.post(say("stranger"), 5, say("stranger refused")));
    EXPECT_TRUE(worker.post(say("guest"), 1, say("guest refused")));
    EXPECT_TRUE(worker.post(say("another stranger"), 5, say("another stranger refused")));
    EXPECT_FALSE(worker.post(say("third stranger"), 5, say("third stranger refused")))
        << "of equal rank the older stays";
    EXPECT_TRUE(worker.post(say("operator"), 0, say("operator refused")));
    gate.set_value();
  }
  EXPECT_EQ(heard, (std::vector<std::string>{"another stranger refused", "operator", "guest", "stranger"}));
}

}  // namespace
}  // namespace docent::telepresence
