#include "docent/localization/pose_watch/scan_rounds.h"

#include <algorithm>

namespace docent::localization {

void ScanRounds::hear(std::size_t laser, Time now) {
  const bool is_second = has_new_[laser];
  has_new_[laser] = true;
  if (is_whole_ || (was_closed_ && now - closed_ < kLeastPause && closed_ <= now)) return;
  const bool has_all = std::all_of(has_new_.begin(), has_new_.end(), [](bool is_new) { return is_new; });
  if (!is_second && !has_all) return;
  is_whole_ = true;
  whole_since_ = now;
}

void ScanRounds::close(Time now) {
  std::fill(has_new_.begin(), has_new_.end(), false);
  is_whole_ = false;
  was_closed_ = true;
  closed_ = now;
}

}  // namespace docent::localization
