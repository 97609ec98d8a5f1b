#pragma once

#include "docent/grid/map_reading.h"
#include "docent/museum/museum.h"

namespace docent::museum {

/// `load_museum`, which says to `progress` how far the reading of the map is.
[[nodiscard]] Result<Museum> load_museum(const std::filesystem::path& folder, Stage stage,
                                         const ReadingProgress& progress);

}  // namespace docent::museum
