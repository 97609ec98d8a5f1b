#pragma once

#include <vector>

#include "docent/pictures/image.h"
#include "docent/simulator/sensing/camera/ceiling/ceiling_light.h"
#include "docent/simulator/sensing/camera/mesh/mesh.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// What stands still in a museum, as it looks.
struct Furnishing {
  Mesh mesh;
  Mesh glass;  ///< panes: eyes see nothing of them, depth cameras do
  std::vector<pictures::Image> posters;
  Ceiling ceiling;
  CeilingLight light;
};

/// Walls in pale colours, a tiled floor with stairs that go down, a ceiling with lamps, furniture, glass cases as their
/// frames, litter, marks, and over each attraction a sign with its name that turns a side to every direction. Each
/// thing has a colour of its own that comes of its id. O(corners of the solids).
[[nodiscard]] Furnishing furnish(const World& world);

/// One of twelve colours that are easy to tell apart, always the same for a name.
[[nodiscard]] Rgb color_of(const std::string& name);

}  // namespace docent::simulator
