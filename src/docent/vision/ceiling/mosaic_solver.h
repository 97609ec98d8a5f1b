#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/vision/ceiling/height_sweep.h"
#include "docent/vision/ceiling/mosaic_drawing.h"

namespace docent::vision {

struct MosaicSolverParams {
  double resolution = 0.02;          ///< [m] of the mosaic, > 0
  double margin = 3.0;               ///< [m] that the mosaic reaches beyond the poses, >= 0
  double steepest = 1.0;             ///< slope of the farthest looks, > 0
  std::vector<int> blocks{8, 4, 2};  ///< [pixels] the pictures are shrunk by, coarse to fine, each > 0
  int samples = 160;                 ///< looks of a picture in a pair, > 0
  int partners = 6;                  ///< pictures that each one is laid on, > 0
  int most_steps = 10;               ///< of Levenberg-Marquardt on each level, > 0
  double position_error = 0.05;      ///< [m] standard deviation of the poses' priors, in x and y each, > 0
  double heading_error = 0.02;       ///< [rad] likewise, > 0
  double gain_error = 0.3;           ///< of the logarithm of a picture's gain, > 0
  double offset_error = 0.15;        ///< of a picture's offset, of 0 .. 1, > 0
  PairScales pair;                   ///< of the residuals
  HeightSweepParams sweep;           ///< finds the parts
  bool solve_heights = true;         ///< else all of the ceiling has the height of its largest part
  bool solve_light = true;           ///< else all pictures are taken to have the same light
  bool use_priors = true;  ///< else only the first picture's pose is held, and the others are started from theirs
  [[nodiscard]] Result<void> validate() const;
};

struct SolvedMosaic {
  CeilingMosaic mosaic;
  std::vector<PlacedPicture> pictures;  ///< the given ones, with what was found of pose and light
  std::size_t unknowns = 0;             ///< of the last level: five a picture, and the heights
  std::size_t residuals = 0;            ///< likewise
  double squares = 0.0;                 ///< mean square of them
};

/// How far it is; false ends the work, with what there is. @param stage  for a person
using MosaicProgress = std::function<bool(const std::string& stage, double share)>;

/// The likeliest ceiling, [Minerva2000] 4.3 and Fig. 10: poses of all pictures, heights of the ceiling's parts, gain
/// and offset of each picture, by Levenberg-Marquardt from coarse pictures to fine ones, with the given poses as
/// priors. The mosaic itself is no unknown: pictures are laid on one another in pairs, and drawn in the end. Parts and
/// their first heights are found by sweep_heights. Deterministic. Error: fewer than three pictures, pictures of another
/// size than the lens, or a ceiling too plain to tell its height.
[[nodiscard]] Result<SolvedMosaic> solve_mosaic(const CeilingCamera& camera, std::span<const PlacedPicture> pictures,
                                                const MosaicSolverParams& params = {},
                                                const MosaicProgress& progress = {});

}  // namespace docent::vision
