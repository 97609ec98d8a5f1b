#pragma once

#include "docent/pictures/image.h"
#include "docent/simulator/sensing/camera/mesh/mesh.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// What the family's printers print: the tag with its black rim, and white round it, a pixel a cell.
[[nodiscard]] pictures::Image picture_of_tag(int tag);

/// The mark as a square of paper. @param poster  its picture's index in the scene's posters
void add_mark(Mesh& mesh, const Mark& mark, std::int16_t poster);

}  // namespace docent::simulator
