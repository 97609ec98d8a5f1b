#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace docent::telepresence {

/// A thread that does one thing after the other. At most `bound` wait.
class Worker {
 public:
  explicit Worker(std::size_t bound) : bound_{bound}, thread_{[this] { run(); }} {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker();  ///< after what waits is done

  /// Any thread. False: too much waits already.
  [[nodiscard]] bool post(std::function<void()> work);

 private:
  void run();

  const std::size_t bound_;
  std::mutex mutex_;
  std::condition_variable wakes_;
  std::deque<std::function<void()>> waiting_;
  bool is_ending_ = false;
  std::thread thread_;  ///< last: it uses the others
};

}  // namespace docent::telepresence
