#pragma once

#include <span>

namespace docent::mapping {

enum class PlaceKind { room, hallway };

/// What a place looks like.
struct PlaceShape {
  double area = 0.0;   ///< [m2]
  double width = 0.0;  ///< [m]: four times the mean distance to the walls, which is the width of whatever is long
  double elongation =
      1.0;        ///< area over the square of that: so many times as long as wide, bends straightened; 2.3 of a square
  int doors = 0;  ///< and other narrow ways out
};

struct PlaceExample {
  PlaceShape shape;
  PlaceKind kind = PlaceKind::room;
};

/// Rooms and hallways of drawn office buildings, labelled where they were drawn.
[[nodiscard]] std::span<const PlaceExample> place_examples();

/// The kind of most of the `nearest` examples whose shapes are most like this one, by width, elongation and doors on
/// logarithmic scales. As RHINO named the places of its map by matching labelled examples [Buhmann1995], which it had
/// of parts of the map itself. O(examples log examples).
[[nodiscard]] PlaceKind kind_of(const PlaceShape& shape, std::span<const PlaceExample> examples, int nearest = 3);

}  // namespace docent::mapping
