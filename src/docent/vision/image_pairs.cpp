#include "docent/vision/image_pairs.h"

#include <algorithm>
#include <chrono>

namespace docent::vision {

void ImagePairs::add(std::deque<Picture>& pictures, Picture picture) {
  // A clock that went back begins anew: older pictures would be the newest for ever.
  if (!pictures.empty() && picture.stamp < pictures.back().stamp) pictures.clear();
  pictures.push_back(std::move(picture));
  if (pictures.size() > kKept) pictures.pop_front();
}

std::optional<PicturePair> ImagePairs::newest() const {
  const auto apart = [](const Picture& a, const Picture& b) { return std::chrono::abs(a.stamp - b.stamp); };
  for (auto robot = robot_.rbegin(); robot != robot_.rend(); ++robot) {
    const auto scene = std::min_element(scene_.begin(), scene_.end(), [&](const Picture& a, const Picture& b) {
      return apart(a, *robot) < apart(b, *robot);
    });
    if (scene != scene_.end() && apart(*scene, *robot) <= tolerance_) return PicturePair{*robot, *scene};
  }
  return std::nullopt;
}

}  // namespace docent::vision
