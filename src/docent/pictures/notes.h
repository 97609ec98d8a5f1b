#pragma once

#include <span>
#include <string>

#include "docent/pictures/axes.h"

namespace docent::pictures {

/// Text beside a place; the part `anchor` of its box lies left of and above it.
struct Note {
  Point2 in_map;  ///< [m]
  std::string text;
  Point2 anchor{0.0, 1.0};
};

/// Draws them all, each inside the frame. A note that would lie on one before it, or on a dot of `dot` points about a
/// place of `clear_of`, moves up or down until it is free, by three of its heights at most. O(notes * (notes +
/// places)).
void draw_notes(Axes& axes, std::span<const Note> notes, std::span<const Point2> clear_of = {}, double dot = 0.0);

}  // namespace docent::pictures
