#pragma once

#include "docent/museum/museum.h"

namespace docent::museum {

/// The museum as a robot knows it that is to map it: what people have marked in it, hazards and area, and where it
/// begins. No map, no exhibit, no tour.
[[nodiscard]] Museum without_map(const Museum& museum, const Pose2& start);

}  // namespace docent::museum
