#pragma once

#include <Eigen/Core>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/vision/depth/depth_camera.h"
#include "docent/vision/depth/ground_plane.h"

namespace docent::vision {

struct FloorThingParams {
  double low = 0.025;     ///< [m] > 0: what is higher over the floor is no floor, beside the camera's noise
  double sigmas = 3.0;    ///< >= 0 of that noise
  double least = 0.035;   ///< [m] > 0: what is neither so high nor so wide is a cable or a fold
  double most = 0.38;     ///< [m] > least: what is higher or wider is furniture
  double foot = 0.07;     ///< [m] > 0: what begins higher over the floor does not stand there
  double gap = 0.05;      ///< [m] > 0: pixels beside each other whose depths differ by more are of two things
  double reach = 2.8;     ///< [m] > 0 on the floor, from the base: farther they are too few pixels
  int least_pixels = 14;  ///< >= 1
  int border = 3;         ///< [pixels] >= 0 of the picture: what reaches there is not seen whole
  template <class V>
  void visit(V& v) {
    v("low", low);
    v("sigmas", sigmas);
    v("least", least);
    v("most", most);
    v("foot", foot);
    v("gap", gap);
    v("reach", reach);
    v("least_pixels", least_pixels);
    v("border", border);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Something small that stands on the floor, seen whole in one depth picture.
struct FloorThing {
  Point2 middle;                                         ///< [m] base
  double width = 0.0;                                    ///< [m] across the line of sight
  double height = 0.0;                                   ///< [m]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< [m²] of `middle`, base
  int pixels = 0;
};

/// What a depth picture shows on the floor.
struct FloorView {
  bool sees_floor = false;         ///< else the rest says nothing
  std::vector<FloorThing> things;  ///< the nearest first
};

/// Parts small things that stand for themselves on the floor from all else, by their form alone: pixels over the floor
/// that hang together, neither as high as furniture nor cut off by the picture's border. O(pixels).
class FloorThingFinder {
 public:
  /// @pre camera and parameters are valid
  explicit FloorThingFinder(const DepthCamera& camera, const FloorThingParams& params = {});

  /// @pre picture has the camera's size
  [[nodiscard]] FloorView find(const DepthPicture& picture, Rng& rng);

  /// Of the picture that was looked at last: bare floor is seen at that place, so that nothing stands there.
  /// @param radius  [m] so far about the place
  [[nodiscard]] bool is_bare(Point2 in_base, double radius) const;

 private:
  enum class Kind : unsigned char { unknown, floor, raised };
  void sort_pixels(const DepthPicture& picture);
  [[nodiscard]] std::vector<FloorThing> clusters(const DepthPicture& picture);
  [[nodiscard]] bool measure(const std::vector<int>& pixels, FloorThing& thing) const;

  DepthCamera camera_;
  Projector projector_;
  FloorThingParams params_;
  GroundPlane ground_;
  DepthPoints points_;
  std::vector<float> heights_;  ///< [pixels] [m]
  std::vector<Kind> kinds_;     ///< [pixels]
};

}  // namespace docent::vision
