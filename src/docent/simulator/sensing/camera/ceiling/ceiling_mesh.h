#pragma once

#include "docent/simulator/sensing/camera/ceiling/ceiling.h"

namespace docent::simulator {

/// Adds the ceiling over the rectangle from `low` to `high`: its fields at their heights, the edges between them, beams
/// and lamps. Triangles of fields and lamps have the finishes of that name and their index as `Look::part`.
void add_ceiling(Mesh& mesh, const Ceiling& ceiling, Point2 low, Point2 high);

}  // namespace docent::simulator
