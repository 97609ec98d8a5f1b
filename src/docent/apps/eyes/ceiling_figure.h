#pragma once

#include <string>

#include "docent/pictures/figure.h"
#include "docent/vision/ceiling/mosaic_solver.h"

namespace docent::apps::map_ceiling_command {

/// A mosaic, its cells as pixels, the map's top first; what no picture showed is bluish.
[[nodiscard]] pictures::Image image_of(const vision::CeilingMosaic& mosaic);

/// The mosaic of a stage, with where the pictures were taken.
[[nodiscard]] pictures::Figure draw_stage(const vision::CeilingMosaic& mosaic, const vision::SolvedMosaic& solved,
                                          const std::string& title);

/// [Minerva2000] Fig. 10: what the believed poses and one light for all make of the pictures, what was found, and the
/// heights of the parts. @param before  the mosaic by the believed poses
[[nodiscard]] pictures::Figure draw_mosaic(const vision::CeilingMosaic& before, const vision::CeilingMosaic& found,
                                           const std::string& title);

}  // namespace docent::apps::map_ceiling_command
