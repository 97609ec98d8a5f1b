#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/vision/ceiling/height_sweep.h"
#include "docent/vision/ceiling/mosaic_drawing.h"
#include "docent/vision/lens/flat_field.h"

namespace docent::vision {

struct MosaicSolverParams {
  double resolution = 0.02;          ///< [m] of the mosaic, > 0
  double margin = 3.0;               ///< [m] that the mosaic reaches beyond the poses, >= 0
  double steepest = 1.0;             ///< slope of the farthest looks, > 0
  std::vector<int> blocks{8, 4, 2};  ///< [pixels] the pictures are shrunk by, coarse to fine, each > 0
  int samples = 160;                 ///< looks of a picture in a pair, > 0
  int partners = 6;                  ///< pictures that each one is laid on, > 0
  int most_steps = 10;               ///< of Levenberg-Marquardt on each level, > 0
  double position_error = 0.04;      ///< [m] standard deviation of the poses' priors, in x and y each, > 0
  double heading_error = 0.012;      ///< [rad] likewise, > 0
  double step_error = 0.003;         ///< [m] standard deviation of odometry from picture to picture, and
  double step_share = 0.02;          ///< of the way; likewise [rad] and of the turn; both > 0
  double mount_error = 0.02;         ///< [rad] of how the camera is said to look, about each level axis, > 0
  double gain_error = 0.3;           ///< of the logarithm of a picture's gain, > 0
  double offset_error = 0.15;        ///< of a picture's offset, of 0 .. 1, > 0
  PairScales pair;                   ///< of the residuals
  HeightSweepParams sweep;           ///< finds the parts
  bool solve_heights = true;         ///< else all of the ceiling has the height of its largest part
  bool solve_mount = true;           ///< else the camera looks as it is said to
  bool solve_light = true;           ///< else all pictures are taken to have the same light
  bool use_priors = true;  ///< else only the first picture's pose is held, the others are started from theirs, and
                           ///< odometry is not heard
  [[nodiscard]] Result<void> validate() const;
};

struct SolvedMosaic {
  CeilingCamera camera;  ///< as it was found to look
  FlatField field;       ///< light that its lens loses towards the rim; gains and offsets are those of pictures without
  CeilingMosaic mosaic;
  std::vector<PlacedPicture> pictures;  ///< the given ones, with what was found of pose and light
  std::size_t unknowns = 0;   ///< of the last level: five a picture, the heights, and two of the camera's mount
  std::size_t residuals = 0;  ///< likewise
  double squares = 0.0;       ///< mean square of them
};

/// How far the work is.
struct MosaicStage {
  std::string name;            ///< for a person
  double share = 0.0;          ///< of all work, 0 .. 1
  bool is_end = false;         ///< of a stage: `so_far` is what it found; elsewhere its poses and light may be older
  const SolvedMosaic& so_far;  ///< poses, light, heights and parts; brightness is empty
};
/// Hears of it some times in each stage; false ends the work, with what there is.
using MosaicProgress = std::function<bool(const MosaicStage&)>;

/// Puts the pictures of what was solved together. @param resolution  [m] of the cells; 0: those it has
[[nodiscard]] CeilingMosaic drawn(const SolvedMosaic& solved, const MosaicSolverParams& params,
                                  double resolution = 0.0);

/// The likeliest ceiling, [Minerva2000] 4.3 and Fig. 10: poses of all pictures, heights of the ceiling's parts, gain
/// and offset of each picture, and how the camera looks up, by Levenberg-Marquardt from coarse pictures to fine ones,
/// with the given poses and odometry as priors. The mosaic itself is no unknown: pictures are laid on one another in
/// pairs, and drawn in the end. Parts and their first heights are found by sweep_heights. Deterministic. Error: fewer
/// than three pictures, pictures of another size than the lens, or a ceiling too plain to tell its height.
[[nodiscard]] Result<SolvedMosaic> solve_mosaic(const CeilingCamera& camera, std::span<const PlacedPicture> pictures,
                                                const MosaicSolverParams& params = {},
                                                const MosaicProgress& progress = {});

}  // namespace docent::vision
