#include "docent/telepresence/store/store_queue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <thread>

namespace docent::telepresence {
namespace {

/// A database that counts how often something is committed, and can be held up.
class SlowDatabase final : public Database {
 public:
  [[nodiscard]] Result<QueryResult> run(const std::string& /*statement*/, const std::vector<Value>& /*a*/) override {
    if (gone) return fail("nobody answers");
    return QueryResult{};
  }
  [[nodiscard]] Result<void> run_script(const std::string& statements) override {
    if (gone) return fail("nobody answers");
    if (statements == "COMMIT") ++commits;
    return {};
  }
  [[nodiscard]] bool is_gone() const override { return gone; }
  std::atomic<bool> gone = false;
  std::atomic<int> commits = 0;

 protected:
  [[nodiscard]] const char* begin_statement() const override { return "BEGIN"; }
};

class StoreQueueTest : public testing::Test {
 protected:
  void make(const StoreQueueParams& params = {}) {
    queue_ = std::make_unique<StoreQueue>(
        database_,
        [this](std::function<void()> work) {
          const std::scoped_lock lock{mutex_};
          posted_.push_back(std::move(work));
        },
        params);
  }
  /// What the caller's thread does until `count` have been told, at most for five seconds.
  void run_until_told(std::size_t count) {
    for (int i = 0; i < 5000 && told_.size() < count; ++i) {
      std::vector<std::function<void()>> posted;
      {
        const std::scoped_lock lock{mutex_};
        posted.swap(posted_);
      }
      for (const auto& work : posted) work();
      if (posted.empty()) std::this_thread::sleep_for(std::chrono::milliseconds{1});
    }
    ASSERT_GE(told_.size(), count);
  }
  void put(const std::string& name) {
    put(name, [] { return Result<void>{}; });
  }
  void put(const std::string& name, StoreQueue::Work work) {
    queue_->put(
        std::move(work),
        [this, name](const Result<void>& done) { told_.push_back(name + (done ? "" : ": " + done.error().message)); },
        now_);
  }
  /// The store's thread stands until `let_go`.
  void hold_up() {
    put("held", [this]() -> Result<void> {
      begun_.set_value();
      gate_.get_future().wait();
      return {};
    });
    begun_.get_future().wait();
  }
  void let_go() { gate_.set_value(); }

  using Names = std::vector<std::string>;
  Time now_ = time_from_seconds(100.0);
  SlowDatabase database_;
  std::mutex mutex_;
  std::vector<std::function<void()>> posted_;
  std::promise<void> begun_, gate_;
  Names told_;
  std::unique_ptr<StoreQueue> queue_;
};

TEST_F(StoreQueueTest, WhatWaitsTogetherIsCommittedTogetherAndToldInOrder) {
  make();
  hold_up();
  for (int i = 0; i < 100; ++i) put(std::to_string(i));
  EXPECT_TRUE(told_.empty());
  let_go();
  run_until_told(101);
  EXPECT_EQ(database_.commits, 2);
  EXPECT_EQ(told_[1], "0");
  EXPECT_EQ(told_[100], "99");
}

TEST_F(StoreQueueTest, OneThatFailsSpoilsNoOther) {
  make();
  hold_up();
  put("a");
  put("bad", [] { return Result<void>{fail("twice the same key")}; });
  put("b");
  let_go();
  run_until_told(4);
  EXPECT_EQ(told_, (Names{"held", "a", "bad: twice the same key", "b"}));
}

TEST_F(StoreQueueTest, WhatFailsCostsOneCommitMoreAndNotOneEach) {
  make();
  hold_up();
  for (int i = 0; i < 100; ++i) put("good");
  put("bad", [] { return Result<void>{fail("twice the same key")}; });
  let_go();
  run_until_told(102);
  EXPECT_EQ(database_.commits, 2) << "the held one's, and one of the hundred";
}

TEST_F(StoreQueueTest, OursWaitForOneWriteOfStrangersAtMost) {
  make({.most_together = 10});
  hold_up();
  const auto put_of = [&](const std::string& name, StoreQueue::Of whom) {
    queue_->put([] { return Result<void>{}; }, [this, name](const Result<void>&) { told_.push_back(name); }, now_,
                whom);
  };
  for (int i = 0; i < 100; ++i) put_of("stranger", StoreQueue::Of::strangers);
  put_of("ours", StoreQueue::Of::ours);
  let_go();
  run_until_told(102);
  EXPECT_LE(std::find(told_.begin(), told_.end(), "ours") - told_.begin(), 11);
}

TEST_F(StoreQueueTest, AfterStrangersTheDatabaseIsLeftToOthersForAWhile) {
  make({.most_together = 1, .most_rest = std::chrono::hours{1}});
  hold_up();
  std::atomic<int> stored = 0;
  for (int i = 0; i < 3; ++i)
    queue_->put(
        [&]() -> Result<void> {
          std::this_thread::sleep_for(std::chrono::milliseconds{30});
          ++stored;
          return {};
        },
        [this](const Result<void>&) { told_.emplace_back("stranger"); }, now_, StoreQueue::Of::strangers);
  const auto begun = std::chrono::steady_clock::now();
  let_go();
  run_until_told(4);
  EXPECT_GE(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds{150})
      << "three times 30 ms, and two rests";
}

TEST_F(StoreQueueTest, WhenTheDatabaseIsGoneAllWhoWaitAreToldAtOnce) {
  make();
  hold_up();
  database_.gone = true;
  std::atomic<int> asked = 0;
  for (int i = 0; i < 500; ++i)
    put("x", [&]() -> Result<void> {
      ++asked;
      return fail("nobody answers");
    });
  let_go();
  run_until_told(501);
  EXPECT_EQ(told_.back(), "x: nobody answers");
  EXPECT_LE(asked, 3) << "each one would wait for the patience";
}

TEST_F(StoreQueueTest, WhoeverWaitsForTooLongIsToldOnce) {
  make();
  hold_up();
  put("a");
  now_ = now_ + seconds(2.0);
  put("b");
  queue_->look(now_);
  EXPECT_TRUE(told_.empty());
  EXPECT_EQ(queue_->waits(now_), seconds(2.0));
  now_ = now_ + seconds(1.0);
  queue_->look(now_);
  EXPECT_EQ(told_, (Names{"held: the database does not answer", "a: the database does not answer"}));
  EXPECT_EQ(queue_->waits(now_), seconds(1.0));
  let_go();
  run_until_told(3);
  EXPECT_EQ(told_.size(), 3U);
  EXPECT_EQ(told_[2], "b");
  EXPECT_EQ(queue_->waits(now_), Duration{});
}

TEST_F(StoreQueueTest, TooManyAreRefused) {
  make({.most_waiting = 2, .kept = 0});
  hold_up();
  for (const char* name : {"a", "b", "c"}) put(name);
  EXPECT_EQ(told_, Names{"c: too much waits to be stored"});
  let_go();
  run_until_told(4);
}

TEST_F(StoreQueueTest, WhatWaitsIsStoredBeforeItEndsAndToldToNobody) {
  make();
  std::atomic<int> stored = 0;
  hold_up();
  for (int i = 0; i < 10; ++i)
    put("x", [&] {
      ++stored;
      return Result<void>{};
    });
  let_go();
  queue_->finish();
  EXPECT_EQ(stored, 10);
  queue_.reset();
  for (const auto& work : posted_) work();
  EXPECT_TRUE(told_.empty());
}

TEST_F(StoreQueueTest, WithoutAThreadItIsDoneAtOnce) {
  StoreQueue queue{database_, {}};
  bool is_told = false;
  queue.put([] { return Result<void>{}; }, [&](const Result<void>& done) { is_told = done.has_value(); }, now_);
  EXPECT_TRUE(is_told);
}

TEST_F(StoreQueueTest, StrangersLeavePlacesForTheOthers) {
  make({.most_waiting = 3, .kept = 2, .most_together = 1});
  hold_up();
  int refused = 0;
  const auto put_of = [&](StoreQueue::Of whom) {
    bool is_refused = false;
    queue_->put([] { return Result<void>{}; }, [&](const Result<void>& stored) { is_refused = !stored; }, now_, whom);
    refused += is_refused;
    return !is_refused;
  };
  while (put_of(StoreQueue::Of::strangers)) {
  }
  EXPECT_TRUE(put_of(StoreQueue::Of::ours));
  EXPECT_TRUE(put_of(StoreQueue::Of::ours));
  EXPECT_FALSE(put_of(StoreQueue::Of::ours)) << "and they are bounded, too";
  EXPECT_EQ(refused, 2);
  let_go();
  queue_->finish();
}

}  // namespace
}  // namespace docent::telepresence
