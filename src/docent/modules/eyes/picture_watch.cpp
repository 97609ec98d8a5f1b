#include "docent/modules/eyes/picture_watch.h"

#include <algorithm>
#include <string_view>

#include "docent/base/random.h"

namespace docent::modules {

bool PictureWatch::hear(Time now, Time taken, std::span<const std::uint8_t> bytes) {
  const std::uint64_t hash = hash_of({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  const bool is_new = !last_ || *last_ != hash;
  if (is_new) changed_ = now;
  last_ = hash;
  heard_ = now;
  is_plain_ = std::all_of(bytes.begin(), bytes.end(), [&](std::uint8_t byte) { return byte == bytes.front(); });
  age_ = now - taken;
  return is_new && !is_plain_ && age_ <= kLate;
}

std::string PictureWatch::complaint(Time now) const {
  if (!heard_) return now - begun_ > kSilent ? "no picture" : "";
  if (now - *heard_ > kSilent) return "no picture any more";
  if (is_plain_) return "nothing is on its pictures: it is covered, in the dark or broken";
  if (now - changed_ > kFrozen) return "is frozen: the same picture again and again";
  if (age_ > kLate) return "pictures are " + std::to_string(age_ / std::chrono::milliseconds{1}) + " ms late";
  return "";
}

}  // namespace docent::modules
