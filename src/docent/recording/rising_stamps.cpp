#include "docent/recording/rising_stamps.h"

namespace docent::recording {

Time RisingStamps::follow(Time stamp) {
  const Time moved = stamp + shift_;
  if (is_first_ || moved >= newest_) {
    is_first_ = false;
    rising_ = 0;
    return newest_ = moved;
  }
  const Duration interval = stamp - late_;
  rising_ = rising_ > 0 && interval.count() > 0 ? rising_ + 1 : 1;
  late_ = stamp;
  if (rising_ < kEnough) return moved;
  ++set_back_;
  rising_ = 0;
  newest_ = newest_ + kEnough * interval;  // as long as these took to come
  shift_ = newest_ - stamp;
  return newest_;
}

}  // namespace docent::recording
