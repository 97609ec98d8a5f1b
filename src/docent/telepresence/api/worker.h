#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

namespace docent::telepresence {

/// A thread that does one thing after the other, of those that wait the one with the smallest rank first, of equal
/// ranks the oldest. At most `bound` wait.
class Worker {
 public:
  explicit Worker(std::size_t bound) : bound_{bound}, thread_{[this] { run(); }} {}
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  ~Worker();  ///< after what waits is done

  /// Any thread. False: too much waits already.
  /// @param refused  called instead of the work, by whoever posts, when something of a smaller rank takes its place
  [[nodiscard]] bool post(std::function<void()> work, int rank = 0, std::function<void()> refused = {});

 private:
  struct Job {
    std::function<void()> work, refused;
  };
  void run();

  const std::size_t bound_;
  std::mutex mutex_;
  std::condition_variable wakes_;
  std::multimap<int, Job> waiting_;  ///< by rank
  bool is_ending_ = false;
  std::thread thread_;  ///< last: it uses the others
};

}  // namespace docent::telepresence
