#pragma once

#include <numbers>

#include "docent/simulator/sensing/camera/optics/lens_model.h"
#include "docent/simulator/world/world.h"

namespace docent::simulator {

/// Tilt of a camera that looks at the ceiling.
inline constexpr double kUp = std::numbers::pi / 2.0;

/// 40 x 30 m, 3.5 m high, its eastern half 18.5 m.
inline World wide_hall(CeilingKind kind = CeilingKind::plain) {
  World world;
  world.floor = {{0.0, 0.0}, {40.0, 0.0}, {40.0, 30.0}, {0.0, 30.0}};
  world.operating_area = world.floor;
  world.ceiling_height = 3.5;
  world.ceiling = {{{{20.0, 0.0}, {40.0, 0.0}, {40.0, 30.0}, {20.0, 30.0}}, 18.5}};
  world.ceiling_style = {kind, 3};
  return world;
}

inline LensModel bent_lens() {
  LensModel lens = plain_lens(320, 240, 1.3);
  lens.centre_x = 164.3, lens.centre_y = 117.8;
  lens.brown = {-0.25, 0.08, 0.001, -0.0008, -0.01};
  return lens;
}
inline LensModel fish_lens() {
  LensModel lens;
  lens.kind = LensKind::fisheye;
  lens.focal_x = lens.focal_y = 95.0;
  lens.fisheye = {-0.03, 0.006, -0.001, 0.0};
  lens.widest = 1.5;
  return lens;
}

}  // namespace docent::simulator
