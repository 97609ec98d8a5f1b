#include "docent/telepresence/api/worker.h"

#include <iterator>
#include <utility>

namespace docent::telepresence {

Worker::~Worker() {
  {
    const std::scoped_lock lock{mutex_};
    is_ending_ = true;
  }
  wakes_.notify_one();
  thread_.join();
}

bool Worker::post(std::function<void()> work, int rank, std::function<void()> refused) {
  Job gives_way;
  {
    const std::scoped_lock lock{mutex_};
    if (is_ending_) return false;
    if (waiting_.size() >= bound_) {
      const auto last = waiting_.empty() ? waiting_.end() : std::prev(waiting_.end());
      if (last == waiting_.end() || last->first <= rank || !last->second.refused) return false;
      gives_way = std::move(last->second);
      waiting_.erase(last);
    }
    waiting_.emplace(rank, Job{std::move(work), std::move(refused)});
  }
  wakes_.notify_one();
  if (gives_way.refused) gives_way.refused();
  return true;
}

void Worker::run() {
  std::unique_lock lock{mutex_};
  while (true) {
    wakes_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const auto work = std::move(waiting_.begin()->second.work);
    waiting_.erase(waiting_.begin());
    lock.unlock();
    work();
    lock.lock();
  }
}

}  // namespace docent::telepresence
