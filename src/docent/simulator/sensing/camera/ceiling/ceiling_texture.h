#pragma once

#include "docent/simulator/sensing/camera/ceiling/ceiling.h"

namespace docent::simulator {

/// The share of light that a field throws back at a place; of glazing, what shines through at noon.
/// @param footprint  [m] across what one pixel sees: what is finer is averaged
[[nodiscard]] Rgb color_at(const CeilingField& field, Point2 in_world, float footprint);

/// What a lamp looks like at a place of its own, 0..1 along and across it.
/// @param share  how much of its light it gives, 0..1
/// @param ambient  light that falls on it, where 0.8 is usual
[[nodiscard]] Rgb color_at(const Lamp& lamp, std::array<float, 2> place, float share, float ambient);

}  // namespace docent::simulator
