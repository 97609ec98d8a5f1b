#include "docent/robot/write_behind.h"

#include <utility>

#include "docent/base/files.h"

namespace docent::robot {

WriteBehind::WriteBehind() : thread_{[this] { work(); }} {}

WriteBehind::~WriteBehind() {
  {
    const std::lock_guard lock{mutex_};
    is_ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void WriteBehind::write(const std::filesystem::path& path, std::string content) {
  {
    const std::lock_guard lock{mutex_};
    waiting_.insert_or_assign(path, std::move(content));
  }
  wake_.notify_one();
}

std::string WriteBehind::fault() const {
  const std::lock_guard lock{mutex_};
  return faults_.empty() ? std::string{} : faults_.begin()->second;
}

void WriteBehind::work() {
  std::unique_lock lock{mutex_};
  while (true) {
    wake_.wait(lock, [this] { return is_ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const auto next = waiting_.extract(waiting_.begin());
    lock.unlock();
    const Result<void> done = write_file_atomically(next.key(), next.mapped());
    lock.lock();
    if (done) {
      faults_.erase(next.key());
    } else {
      faults_.insert_or_assign(next.key(), done.error().message);
    }
  }
}

}  // namespace docent::robot
