#pragma once

#include <functional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/vision/ceiling/ceiling_mosaic.h"
#include "docent/vision/ceiling/mosaic_pair.h"

namespace docent::vision {

struct HeightSweepParams {
  double least = 2.2;      ///< [m] above the floor, > 0: heights that are tried, to
  double most = 25.0;      ///< [m] > least
  double step = 0.03;      ///< from one to the next, as a share, > 0
  double cell = 0.15;      ///< [m] side of the cells that choose, > 0
  double window = 0.75;    ///< [m] round a cell that is compared: what is flat there says nothing, > 0
  double smallest = 0.6;   ///< [m^2] of a part of its own height that can be told by its texture, > 0
  double texture = 0.008;  ///< of 0 .. 1: pictures of a cell that differ by less tell nothing, > 0
  double unlike = 0.08;    ///< of 0 .. 1: where pictures differ by more at all heights, there is no ceiling, > 0
  double steepest = 1.0;   ///< slope of the farthest looks, > 0
  double same = 0.08;      ///< heights that differ by less, as a share, are one part, > 0
  double farthest = 1.6;   ///< [m] along the floor of the farthest looks, > 0: from farther aside, lower parts hide
                           ///< higher ones; more where a cell would lie in fewer than
  double looks = 10.0;     ///< pictures, on the average, > 0
  std::size_t pictures = 2000;  ///< at most so many, spread over all, > 0
  [[nodiscard]] Result<void> validate() const;
};

/// The parts of a ceiling and their heights, from pictures at known poses: at its right height, all pictures show the
/// same at a place (plane sweep). Parts are joined from cells that agree; each of a mosaic's cells belongs to the part
/// that explains it best, its neighbours' counts, too. Brightness stays empty. Where there is no texture, the
/// neighbours and the largest part decide.
/// @param frame    of the mosaic
/// @param pictures, unknowns  one for one; their gains are used, and nothing else of their light
[[nodiscard]] CeilingMosaic sweep_heights(const GridFrame& frame, const CeilingCamera& camera,
                                          std::span<const ShrunkPicture> pictures,
                                          std::span<const PictureUnknowns> unknowns,
                                          const HeightSweepParams& params = {});

}  // namespace docent::vision
