#pragma once

#include <array>
#include <cstddef>

#include "docent/vision/objects/standing_thing.h"
#include "docent/vision/regions/sites.h"

namespace docent::vision {

inline constexpr std::size_t kFeatures = 17;

/// What the recognizer of [Buhmann1995] looks at: luminance, colour and geometry of a thing, here with how rough it is.
using Features = std::array<double, kFeatures>;

/// [kFeatures] of each feature, for people and for files.
[[nodiscard]] const std::array<const char*, kFeatures>& feature_names();

/// Of the thing. Luminance is normalized by that of the ground, colours by its tint: one lamp is as good as another.
/// Sizes are shares of the picture, for no distance is known. O(sites).
/// @pre thing.sites > 0
[[nodiscard]] Features features_of(const Sites& sites, const StandingThing& thing);

}  // namespace docent::vision
