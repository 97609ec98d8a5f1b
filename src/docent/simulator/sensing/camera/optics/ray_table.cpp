#include "docent/simulator/sensing/camera/optics/ray_table.h"

namespace docent::simulator {

RayTable::RayTable(const LensModel& lens)
    : width_{lens.width}, height_{lens.height}, pixel_angle_{static_cast<float>(1.0 / lens.focal_x)} {
  for (int y = 0; y <= height_; ++y)
    for (int x = 0; x <= width_; ++x) corners_.push_back(lens.ray(x, y));
  const auto is_seen = [&](int x, int y) {
    const Vec3 ray = corners_[static_cast<std::size_t>(y * (width_ + 1) + x)];
    return dot(ray, ray) > 0.0F;
  };
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      sees_.push_back(is_seen(x, y) && is_seen(x + 1, y) && is_seen(x, y + 1) && is_seen(x + 1, y + 1));
}

}  // namespace docent::simulator
