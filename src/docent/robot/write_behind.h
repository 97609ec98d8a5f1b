#pragma once

#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>

namespace docent::robot {

/// Writes small files on a thread of its own, so that no disk holds up whoever has something more urgent to do. Of one
/// file the newest content counts; each is written atomically and synced. The end waits until all is tried. Any thread.
class WriteBehind {
 public:
  WriteBehind();
  WriteBehind(const WriteBehind&) = delete;
  WriteBehind& operator=(const WriteBehind&) = delete;
  ~WriteBehind();

  void write(const std::filesystem::path& path, std::string content);
  /// Why the newest write of some file did not succeed; empty: all did. A later write that succeeds takes it back.
  [[nodiscard]] std::string fault() const;

 private:
  void work();

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::map<std::filesystem::path, std::string> waiting_;
  std::map<std::filesystem::path, std::string> faults_;
  bool is_ending_ = false;
  std::thread thread_;  ///< last: it uses the rest
};

}  // namespace docent::robot
