#include "docent/simulator/physique/slice.h"

#include <algorithm>
#include <limits>

namespace docent::simulator {

Disc nearest_part(const Posture& posture, Point2 from, double height) {
  Disc nearest{posture.at, posture.physique->reach};
  double least = std::numeric_limits<double>::infinity();
  for (const BodyPart& part : posture.physique->parts) {
    if (part.bottom >= height) continue;
    const Disc disc = posture.place(part);
    const Point2 offset = disc.centre - from;
    const double bound = least + disc.radius;
    if (bound <= 0.0 || dot(offset, offset) >= bound * bound) continue;  // no root for most
    least = norm(offset) - disc.radius;
    nearest = disc;
  }
  return nearest;
}

double reach_towards(const Posture& posture, Point2 towards) {
  double reach = 0.0;
  for (const BodyPart& part : posture.physique->parts) {
    const Disc disc = posture.place(part);
    reach = std::max(reach, dot(disc.centre - posture.at, towards) + disc.radius);
  }
  return reach;
}

template <class Takes>
void Slice::gather(std::span<const Posture> people, Point2 from, double reach, const Takes& takes) {
  discs_.clear();
  persons_.clear();
  for (std::size_t person = 0; person < people.size(); ++person) {
    const Posture& posture = people[person];
    const Point2 offset = posture.at - from;
    const double most = reach + posture.physique->reach;
    if (dot(offset, offset) > 1.01 * most * most) continue;  // most are out of reach
    for (const BodyPart& part : posture.physique->parts) {
      if (!takes(part)) continue;
      discs_.push_back(posture.place(part));
      persons_.push_back(static_cast<std::uint32_t>(person));
    }
  }
}

void Slice::cut(std::span<const Posture> people, double height, Point2 from, double reach) {
  gather(people, from, reach, [&](const BodyPart& part) { return part.bottom <= height && height <= part.top; });
}

void Slice::cut_trunks(std::span<const Posture> people, Point2 from, double reach) {
  gather(people, from, reach, [](const BodyPart& part) { return part.is_trunk; });
}

}  // namespace docent::simulator
