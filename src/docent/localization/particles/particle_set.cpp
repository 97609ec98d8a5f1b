#include "docent/localization/particles/particle_set.h"

#include <algorithm>

namespace docent::localization {

void ParticleSet::resize(std::size_t count) {
  const std::size_t padded = (count + kPadding - 1) / kPadding * kPadding;
  for (auto* const values : {&x, &y, &heading_y, &weight}) {
    if (count < size_) std::fill(values->begin() + static_cast<std::ptrdiff_t>(count), values->end(), 0.0F);
    values->resize(padded, 0.0F);
  }
  if (count < size_) std::fill(heading_x.begin() + static_cast<std::ptrdiff_t>(count), heading_x.end(), 1.0F);
  heading_x.resize(padded, 1.0F);
  size_ = count;
}

void ParticleSet::set(std::size_t i, const Pose2& map_from_robot, float w) {
  x[i] = static_cast<float>(map_from_robot.x);
  y[i] = static_cast<float>(map_from_robot.y);
  const Point2 heading = unit(map_from_robot.theta);
  heading_x[i] = static_cast<float>(heading.x);
  heading_y[i] = static_cast<float>(heading.y);
  weight[i] = w;
}

void ParticleSet::append(const ParticleSet& others) {
  const std::size_t first = size_;
  resize(first + others.size());
  const auto copy = [&](const std::vector<float>& from, std::vector<float>& to) {
    std::copy_n(from.begin(), others.size(), to.begin() + static_cast<std::ptrdiff_t>(first));
  };
  copy(others.x, x), copy(others.y, y), copy(others.weight, weight);
  copy(others.heading_x, heading_x), copy(others.heading_y, heading_y);
}

double ParticleSet::mass(std::size_t first, std::size_t last) const {
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) sum += static_cast<double>(weight[i]);
  return sum;
}

}  // namespace docent::localization
