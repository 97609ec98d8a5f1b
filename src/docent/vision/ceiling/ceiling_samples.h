#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/vision/ceiling/ceiling_camera.h"

namespace docent::vision {

/// One look at the ceiling: the mean of a block of pixels, and where it looks.
struct CeilingSample {
  float slope_x = 0.0F;     ///< metres ahead of the lens for each metre that the ceiling is above it,
  float slope_y = 0.0F;     ///< and to the left; the robot's axes
  float brightness = 0.0F;  ///< 0 .. 1
};

struct CeilingSamplesParams {
  int block = 4;          ///< [pixels] side of a block: a low-pass filter, 1 .. 64
  double steepest = 2.0;  ///< farthest look, as a slope: beyond, errors of the mount count too much; > 0
  double edge = 0.04;     ///< difference between neighbours, of 0 .. 1, from which a block lies at an edge; > 0
  int most = 600;         ///< samples of a picture, > 0; of those at edges; a few more stand for what is flat
  int flat_step = 5;      ///< [blocks] one in so many columns and rows of what is flat is taken, > 0
};

/// Takes samples of pictures of one camera. The rays of all blocks are worked out once.
class CeilingSampler {
 public:
  CeilingSampler(const CeilingCamera& camera, const CeilingSamplesParams& params = {});

  [[nodiscard]] const CeilingCamera& camera() const { return camera_; }
  /// Those of a picture: where neighbours differ, and a few of what is flat. The same for the same picture.
  /// @pre the picture has the lens's size. The span is valid until the next call.
  [[nodiscard]] std::span<const CeilingSample> take(const GrayPicture& picture);
  /// Standard deviation of brightness over the ceiling in the last picture, 0 .. 0.5.
  [[nodiscard]] double contrast() const { return contrast_; }

 private:
  void take_means(const GrayPicture& picture);

  struct Block {
    int index = 0;
    float slope_x = 0.0F, slope_y = 0.0F;
    bool is_inner = false;  ///< its four neighbours look at the ceiling, too
    bool is_sparse = false;
  };
  CeilingCamera camera_;
  CeilingSamplesParams params_;
  int columns_;
  int rows_;
  std::vector<Block> blocks_;
  std::vector<float> means_;                ///< of all blocks of the last picture
  std::vector<std::uint16_t> column_sums_;  ///< of a row of blocks, for each column of pixels
  std::vector<CeilingSample> edges_;
  std::vector<CeilingSample> taken_;
  double contrast_ = 0.0;
};

}  // namespace docent::vision
