#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "docent/telepresence/store/store_backups.h"

namespace docent::telepresence {

/// Makes the backup of each day on a thread of its own, so that nobody waits for it.
class BackupKeeper {
 public:
  explicit BackupKeeper(std::optional<StoreBackups> backups) : backups_{std::move(backups)} {}
  BackupKeeper(const BackupKeeper&) = delete;
  BackupKeeper& operator=(const BackupKeeper&) = delete;
  ~BackupKeeper() { finish(); }

  /// Now and then: begins one where there is none of this day, an hour after one that failed.
  void look(std::int64_t now_s);
  void finish();                            ///< waits for what has begun
  [[nodiscard]] std::string fault() const;  ///< why the newest could not be made; empty: it could

 private:
  const std::optional<StoreBackups> backups_;
  std::atomic<bool> is_working_ = false;
  std::int64_t again_s_ = 0;
  mutable std::mutex mutex_;
  std::string fault_;   ///< guarded by it
  std::thread thread_;  ///< last: it uses the others
};

}  // namespace docent::telepresence
