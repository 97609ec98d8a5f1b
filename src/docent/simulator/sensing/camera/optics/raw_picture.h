#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/simulator/sensing/camera/mesh/mesh.h"

namespace docent::simulator {

/// What falls on a sensor, before it makes numbers of it.
struct RawPicture {
  int width = 0;            ///< [pixels]
  int height = 0;           ///< [pixels]
  std::vector<Rgb> light;   ///< [height][width] linear, 0.8 is a white sheet; may exceed 1
  std::vector<Vec3> where;  ///< [height][width], camera's frame: unit rays; {0, 0, 0} where the lens lets no light in
};

/// What a depth camera meets, of the same pixels.
struct RawDepth {
  struct Meeting {
    float z = 0.0F;           ///< [m] along the optical axis to the first thing that is no glass; 0: nothing
    float glass = 0.0F;       ///< [m] likewise to a pane before it; 0: none
    float slant = 1.0F;       ///< cosine between the ray and the surface's normal
    float brightness = 0.0F;  ///< of the surface, 0..1
    bool is_lit = false;      ///< the projector beside the camera reaches it
  };
  int width = 0;                  ///< [pixels]
  int height = 0;                 ///< [pixels]
  std::vector<Meeting> meetings;  ///< [height][width]
};

/// The mean of pictures of one camera: what it sees while it moves. @pre at least one, all of one size
[[nodiscard]] RawPicture mean_of(std::span<const RawPicture> pictures);

}  // namespace docent::simulator
