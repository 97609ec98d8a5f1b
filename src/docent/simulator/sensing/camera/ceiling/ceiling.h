#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "docent/geometry/polygon.h"
#include "docent/simulator/sensing/camera/mesh/mesh.h"

namespace docent::simulator {

/// Lamps are switched in so many circuits, each for some neighbourhoods of the building.
inline constexpr std::size_t kLampCircuits = 8;

/// What shines at the moment of a picture.
struct Lighting {
  std::array<float, kLampCircuits> circuits{1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F, 1.0F};  ///< 0 off .. 1 on
  float daylight = 1.0F;  ///< 0 night .. 1 noon: what comes in by skylights and windows
};

/// What a part of a ceiling is made of.
enum class Covering : std::uint8_t {
  panels,    ///< a grid of panels, each with its own fate
  plaster,   ///< smooth, with stains and cracks
  roof,      ///< planks
  glazing,   ///< panes that the sky shines through
  periodic,  ///< panels, all the same
  plain,     ///< one colour
};

/// A part of the ceiling at one height.
struct CeilingField {
  double height = 3.0;  ///< [m] above the floor
  Covering covering = Covering::plain;
  Point2 origin;                   ///< [m], world: a corner of its grid
  Point2 along{1.0, 0.0};          ///< of length 1, world: the grid's first direction
  double length = 0.6;             ///< [m] of a panel, along it
  double width = 0.6;              ///< [m] of a panel, across it
  Rgb color{0.80F, 0.80F, 0.78F};  ///< share of the light that it throws back
  std::uint64_t seed = 0;          ///< of what is on it by chance
  [[nodiscard]] Point2 to_grid(Point2 in_world) const {
    const Point2 p = in_world - origin;
    return {dot(along, p), cross(along, p)};
  }
  [[nodiscard]] Point2 to_world(Point2 in_grid) const {
    return origin + in_grid.x * along + in_grid.y * Point2{-along.y, along.x};
  }
};

enum class LampKind : std::uint8_t {
  troffer,    ///< a flat box in the place of panels, with a louvre
  downlight,  ///< a round one, sunk in
  tube,       ///< hangs on two wires and lights the ceiling, too
  globe,      ///< hangs on a wire
};

struct Lamp {
  LampKind kind = LampKind::troffer;
  Pose2 pose;                  ///< world, of its middle
  double length = 0.6;         ///< [m]; of round ones the diameter
  double width = 0.6;          ///< [m]
  double height = 3.0;         ///< [m] above the floor, of its underside
  double ceiling = 3.0;        ///< [m] height of what it is fixed to
  int circuit = 0;             ///< 0..kLampCircuits - 1
  bool is_dead = false;        ///< never shines
  float radiance = 4.0F;       ///< where a white sheet in the hall has about 0.8
  Rgb tint{1.0F, 1.0F, 1.0F};  ///< of its light
};

/// A beam below the ceiling.
struct Beam {
  Segment axis;         ///< [m], world
  double width = 0.3;   ///< [m]
  double top = 3.0;     ///< [m] above the floor
  double bottom = 2.7;  ///< [m]
  Rgb color;
};

/// All that is overhead in a building.
struct Ceiling {
  std::vector<Polygon> outlines;     ///< [fields - 1] of field 1, 2, …; the last one that holds a point counts
  std::vector<CeilingField> fields;  ///< [0] is where no outline is
  std::vector<Lamp> lamps;
  std::vector<Beam> beams;
  bool is_even = false;  ///< the light is the same everywhere: of the periodic and the plain kind
  [[nodiscard]] std::size_t field_at(Point2 in_world) const;  ///< index in fields
};

/// How much light the lamp gives under this lighting, 0..1.
[[nodiscard]] inline float share_of(const Lamp& lamp, const Lighting& lighting) {
  return lamp.is_dead ? 0.0F : lighting.circuits[static_cast<std::size_t>(lamp.circuit)];
}

}  // namespace docent::simulator
