#pragma once

#include "docent/simulator/sensing/camera/ceiling/ceiling.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// Draws the ceiling of a museum: the heights are the world's, all else comes of `world.ceiling_style` and its seed.
/// The same world and seed give the same ceiling. Nothing of it stands in a file that a robot could read.
[[nodiscard]] Ceiling design_ceiling(const World& world);

/// The seed of a museum that names none: comes of its floor and its exhibits, which no scenario changes.
[[nodiscard]] std::uint64_t own_seed(const World& world);

}  // namespace docent::simulator
