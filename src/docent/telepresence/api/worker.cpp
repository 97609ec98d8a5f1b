#include "docent/telepresence/api/worker.h"

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

bool Worker::post(std::function<void()> work) {
  {
    const std::scoped_lock lock{mutex_};
    if (is_ending_ || waiting_.size() >= bound_) return false;
    waiting_.push_back(std::move(work));
  }
  wakes_.notify_one();
  return true;
}

void Worker::run() {
  std::unique_lock lock{mutex_};
  while (true) {
    wakes_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const auto work = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    work();
    lock.lock();
  }
}

}  // namespace docent::telepresence
