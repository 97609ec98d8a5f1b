#pragma once

#include "docent/simulator/sensing/camera/mesh/mesh.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// A can, a wad of paper or a bin where the solid stands, as wide and as high as it; shades come of its id.
/// @pre solid.form is none of a prism
void add_litter(Mesh& mesh, const Solid& solid);

}  // namespace docent::simulator
