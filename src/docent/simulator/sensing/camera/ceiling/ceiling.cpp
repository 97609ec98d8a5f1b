#include "docent/simulator/sensing/camera/ceiling/ceiling.h"

#include "docent/simulator/sensing/camera/mesh/level_parts.h"

namespace docent::simulator {

std::size_t Ceiling::field_at(Point2 in_world) const {
  return static_cast<std::size_t>(owner_at(outlines, in_world) + 1);
}

}  // namespace docent::simulator
