#pragma once

#include <functional>

#include "docent/grid/occupancy_grid.h"

namespace docent {

/// Hears how far a reading is, some times in its course. @param done  share of the image's rows, 0..1
using ReadingProgress = std::function<void(double done)>;

/// `read_map`, which says to `progress` how far it is: an image may have 400 million pixels.
[[nodiscard]] Result<LoadedMap> read_map(const std::filesystem::path& yaml, const ReadingProgress& progress);

}  // namespace docent
