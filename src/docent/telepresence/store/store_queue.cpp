#include "docent/telepresence/store/store_queue.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace docent::telepresence {

StoreQueue::StoreQueue(Database& database, Post post, const StoreQueueParams& params)
    : database_{database}, post_{std::move(post)}, params_{params}, self_{std::make_shared<StoreQueue*>(this)} {
  if (has_thread()) thread_ = std::thread{[this, queue = std::weak_ptr{self_}] { run(queue); }};
}

void StoreQueue::put(Work work, Done done, Time now, Of whom) {
  if (!has_thread()) return done(database_.in_transaction(work));
  auto job = std::make_shared<Job>(Job{std::move(work), std::move(done), now, {}});
  bool is_full = false;
  {
    const std::scoped_lock lock{mutex_};
    is_full = ours_.size() + strangers_.size() >= params_.most_waiting + (whom == Of::ours ? params_.kept : 0);
    if (!is_full) (whom == Of::ours ? ours_ : strangers_).push_back(job);
  }
  if (is_full) return tell(*job, fail("too much waits to be stored"));
  told_of_.push_back(std::move(job));
  wakes_.notify_one();
}

void StoreQueue::look(Time now) {
  while (!told_of_.empty() && (!told_of_.front()->done || now - told_of_.front()->since > params_.patience)) {
    const auto job = std::move(told_of_.front());
    told_of_.pop_front();
    tell(*job, fail("the database does not answer"));
  }
}

Duration StoreQueue::waits(Time now) const {
  const auto oldest = std::find_if(told_of_.begin(), told_of_.end(), [](const auto& job) { return bool{job->done}; });
  return oldest == told_of_.end() ? Duration{} : now - (*oldest)->since;
}

void StoreQueue::finish() {
  self_.reset();
  if (!thread_.joinable()) return;
  {
    const std::scoped_lock lock{mutex_};
    is_ending_ = true;
  }
  wakes_.notify_one();
  thread_.join();
}

StoreQueue::Jobs StoreQueue::next(bool& is_of_strangers) {
  is_of_strangers = ours_.empty() || (!is_of_strangers && !strangers_.empty());
  auto& waiting = is_of_strangers ? strangers_ : ours_;
  const auto count = static_cast<std::ptrdiff_t>(std::min(waiting.size(), params_.most_together));
  Jobs jobs{waiting.begin(), waiting.begin() + count};
  waiting.erase(waiting.begin(), waiting.begin() + count);
  return jobs;
}

void StoreQueue::run(const std::weak_ptr<StoreQueue*>& queue) {
  using Clock = std::chrono::steady_clock;
  bool is_of_strangers = true;
  std::unique_lock lock{mutex_};
  while (true) {
    wakes_.wait(lock, [this] { return is_ending_ || !ours_.empty() || !strangers_.empty(); });
    if (ours_.empty() && strangers_.empty()) return;
    Jobs jobs = next(is_of_strangers);
    lock.unlock();
    const auto begun = Clock::now();
    do_all(jobs);
    const Duration took = Clock::now() - begun;
    lock.lock();
    if (database_.is_gone()) {
      const Result<void> why = jobs.back()->result;
      for (auto* waiting : {&ours_, &strangers_}) {
        for (auto& job : *waiting) jobs.emplace_back(std::move(job))->result = why;
        waiting->clear();
      }
    }
    lock.unlock();
    post_([queue, jobs = std::move(jobs)] {
      if (const auto self = queue.lock()) (*self)->tell(jobs);
    });
    lock.lock();
    if (is_of_strangers)
      wakes_.wait_for(lock, std::min(took, params_.most_rest), [this] { return is_ending_ || !ours_.empty(); });
  }
}

void StoreQueue::do_all(const Jobs& jobs) {
  const auto all = database_.in_transaction([&]() -> Result<void> {
    for (const auto& job : jobs)
      if (auto done = job->work(); !done) return done;
    return {};
  });
  for (const auto& job : jobs) job->result = all;
  // One of them may be to blame for all, unless nobody is there to ask.
  if (all || jobs.size() == 1 || database_.is_gone()) return;
  const auto others = database_.in_transaction([&]() -> Result<void> {
    for (const auto& job : jobs) {
      if (auto begun = database_.run_script("SAVEPOINT one"); !begun) return begun;
      job->result = job->work();
      if (database_.is_gone()) return job->result;
      if (auto ended = database_.run_script(job->result ? "RELEASE one" : "ROLLBACK TO one; RELEASE one"); !ended)
        return ended;
    }
    return {};
  });
  if (others) return;
  for (const auto& job : jobs) job->result = others;
}

void StoreQueue::tell(const Jobs& jobs) {
  for (const auto& job : jobs) tell(*job, job->result);
  while (!told_of_.empty() && !told_of_.front()->done) told_of_.pop_front();
}

void StoreQueue::tell(Job& job, const Result<void>& result) {
  if (const Done done = std::exchange(job.done, {})) done(result);
}

}  // namespace docent::telepresence
