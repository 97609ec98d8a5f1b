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

}  // namespace
}  // namespace docent::telepresence
