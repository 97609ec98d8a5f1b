#include "docent/telepresence/service/backup_keeper.h"

namespace docent::telepresence {
namespace {

constexpr std::int64_t kAgain = 3600;  ///< [s]

}  // namespace

void BackupKeeper::look(std::int64_t now_s) {
  if (!backups_ || is_working_ || now_s < again_s_ || !backups_->is_due(now_s)) return;
  finish();
  again_s_ = now_s + kAgain;
  is_working_ = true;
  thread_ = std::thread{[this, now_s] {
    const auto made = backups_->make(now_s);
    {
      const std::scoped_lock lock{mutex_};
      fault_ = made ? "" : "no backup: " + made.error().message;
    }
    is_working_ = false;
  }};
}

void BackupKeeper::finish() {
  if (thread_.joinable()) thread_.join();
}

std::string BackupKeeper::fault() const {
  const std::scoped_lock lock{mutex_};
  return fault_;
}

}  // namespace docent::telepresence
