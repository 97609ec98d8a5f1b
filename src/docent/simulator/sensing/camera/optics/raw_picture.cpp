#include "docent/simulator/sensing/camera/optics/raw_picture.h"

namespace docent::simulator {

RawPicture mean_of(std::span<const RawPicture> pictures) {
  RawPicture mean = pictures.front();
  for (const RawPicture& picture : pictures.subspan(1))
    for (std::size_t i = 0; i < mean.light.size(); ++i) mean.light[i] = mean.light[i] + picture.light[i];
  const float share = 1.0F / static_cast<float>(pictures.size());
  for (Rgb& light : mean.light) light = share * light;
  return mean;
}

}  // namespace docent::simulator
