#pragma once

#include <ceres/cost_function.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/vision/ceiling/ceiling_camera.h"
#include "docent/vision/ceiling/ceiling_samples.h"
#include "docent/vision/ceiling/shrunk_picture.h"

namespace docent::vision {

/// The unknowns of a picture.
struct PictureUnknowns {
  std::array<double, 3> pose{};   ///< x, y [m], theta [rad]
  std::array<double, 2> light{};  ///< ln of the gain, and the offset, of 0 .. 1: shown = gain * ceiling + offset
};

/// A look of one picture, with the part of the ceiling that it hits.
struct PartSample {
  CeilingSample look;
  std::uint8_t part = 0;
};

struct PairScales {
  double brightness = 0.05;   ///< standard deviation of what is left, of 0 .. 1
  double outlier = 1.0;       ///< of those, from which Cauchy's loss grows slowly
  double independent = 15.0;  ///< residuals of a pair that count: neighbours err together
};

/// Two pictures that overlap, [Minerva2000] 4.3 in pairs: what one shows, and what the other shows where it sees the
/// same place of the ceiling. Residuals are exp((g_k - g_i) / 2) (I_i - b_i) - exp((g_i - g_k) / 2) (I_k - b_k):
/// between the two pictures' gains, so that none gains by growing dark. Parameters: pose and light of both, then how
/// the camera is turned against its mount (about the robot's x and y axes [rad], a first approximation), then the
/// heights [m] of the parts that the samples hit, in `parts`' order. A sample that the other does not see counts
/// nothing.
class MosaicPair final : public ceres::CostFunction {
 public:
  /// @pre camera and `other` outlive it
  MosaicPair(const CeilingCamera& camera, std::vector<PartSample> samples, std::vector<std::uint8_t> parts,
             const ShrunkPicture& other, const PairScales& scales);
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const CeilingCamera& camera_;
  std::vector<PartSample> samples_;  ///< `part` is an index of parameters here
  const ShrunkPicture& other_;
  PairScales scales_;
  double weight_;
};

}  // namespace docent::vision
