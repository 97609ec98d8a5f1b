#pragma once

#include <filesystem>

#include "docent/base/result.h"
#include "docent/vision/ceiling/ceiling_mosaic.h"

namespace docent::vision {

/// Writes a mosaic as a map of the ceiling, in the manner of map_server's maps: `path`, a YAML file with `resolution`
/// [m], `origin` [x, y] of the lower left corner in the map, `heights` [m] of the parts, `brightness` (what black and
/// white mean), and the names of two PNG images beside it, NAME-picture.png (grey of 16 bits) and NAME-parts.png (grey
/// of 8 bits: the number of the part, 255 for unknown); their first rows are the map's top. Each file is written
/// whole or not at all, the YAML last; it holds a digest of both images, so that a set that was torn is noticed, and
/// `cut_short: true` where the making was ended early. Error: a path without the extension .yaml, a mosaic that is not
/// consistent, or a disk that fails.
[[nodiscard]] Result<void> write_ceiling(const std::filesystem::path& path, const CeilingMosaic& mosaic);

/// Reads what write_ceiling wrote; brightness comes back to 1/60,000 of its range. Images may be changed by hand where
/// the line `digest` is taken out. Error: "FILE:LINE: ...".
[[nodiscard]] Result<CeilingMosaic> read_ceiling(const std::filesystem::path& path);

}  // namespace docent::vision
