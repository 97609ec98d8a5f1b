#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "docent/vision/calibration/board_finder.h"
#include "docent/vision/lens/lens.h"

namespace docent::vision {

struct LensCalibrationParams {
  LensParams::Kind kind = LensParams::Kind::pinhole;
  int least_pictures = 8;      ///< >= 3
  double most_off = 3.0;       ///< > 1: a picture that is off by so many times the median of all is left out
  double good_rms = 0.5;       ///< [pixels] > 0 of a calibration that is worth its name
  double good_coverage = 0.6;  ///< 0..1 of the picture's parts that hold a corner
  double least_tilt = 15.0;    ///< [deg] >= 0 that some boards are turned from the picture's plane, or nothing tells
                               ///< the focal length from the distance
  [[nodiscard]] Result<void> validate() const;
};

/// How the corners of one picture fit.
struct CalibratedView {
  std::string name;
  double rms = 0.0;   ///< [pixels]
  double tilt = 0.0;  ///< [deg] of the board from the picture's plane
  bool counts = true;
};

/// A lens, and how much it is to be believed.
struct LensCalibration {
  LensParams lens;
  double rms = 0.0;  ///< [pixels] of all corners that count
  std::vector<CalibratedView> views;
  double coverage = 0.0;                                ///< share of the 8 x 6 parts of the picture that hold a corner
  std::array<double, 2> focal_sigma{}, centre_sigma{};  ///< [pixels] standard deviations; 0 of a fisheye: not told
  /// What speaks against it, for a person; empty: nothing.
  std::vector<std::string> doubts;
};

/// The lens that makes the boards' corners fall where they were seen: OpenCV's least squares over lens and
/// boards; pictures that fit far worse than the others are left out once. Deterministic, one thread.
/// Error: too few pictures, corners of another board, or nothing fits.
/// @param columns, rows  [pixels] of the pictures
[[nodiscard]] Result<LensCalibration> calibrate_lens(std::span<const BoardView> views, const Board& board, int columns,
                                                     int rows, const LensCalibrationParams& params = {});

}  // namespace docent::vision
