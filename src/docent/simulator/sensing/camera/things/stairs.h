#pragma once

#include "docent/simulator/sensing/camera/mesh/mesh.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// The side of the stairs at which one steps onto them: of those that neither a wall nor a rail closes the shortest,
/// and where all are closed the shortest of all. Index of its first corner.
[[nodiscard]] std::size_t entry_of(const Solid& stairs, const World& world);

/// Steps that go down from that side, 17 cm by 28, to the stairs' bottom or as far as there is room, and the walls of
/// the hole. The floor must have a hole there.
void add_stairs(Mesh& mesh, const Solid& stairs, const World& world);

}  // namespace docent::simulator
