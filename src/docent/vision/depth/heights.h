#pragma once

#include <utility>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/vision/depth/ground_plane.h"

namespace docent::vision {

struct HeightParams {
  double low = 0.03;          ///< [m] > 0: what is higher over the floor is in the way; carpets and sills are lower
  double robot_height = 1.4;  ///< [m] > low: what hangs higher is not
  double drop = 0.05;         ///< [m] > 0: a floor so much deeper is none
  double sigmas = 2.5;        ///< >= 0 of the camera's noise, beyond these heights
  double tilt_sigma = 0.3;    ///< [deg] >= 0 of the camera's shaking between two pictures of the floor
  double nearest = 0.35;      ///< [m] >= 0 along the axis: nearer is nothing measured
  double reach = 4.0;         ///< [m] > nearest, likewise: farther is too coarse for 3 cm
  double drop_reach = 3.0;    ///< [m] > 0 on the floor, likewise: farther its pixels are too few to free it again
  double floor_reach = 2.5;   ///< [m] > 0, likewise: nearer than this a floor is seen where there is one
  double blind_share = 0.2;   ///< 0..1: a picture of which less came back says nothing
  int edge = 3;               ///< [pixels] >= 0 at the picture's border that mark nothing: what is marked must be seen
                              ///< again by whole rays, or it would stay
  double flying = 0.04;       ///< > 0 of the depth: a pixel that is so far from its neighbours on both sides is a
                              ///< mixture of what lies before and behind an edge
  double shadow = 22.0;       ///< [pixels m] >= 0: the projector's shadow beside a thing at 1 m, at 320 columns
  [[nodiscard]] Result<void> validate() const;
};

/// A point of the base frame that something says about the floor under it.
struct HeightPoint {
  enum class Kind : unsigned char {
    obstacle,  ///< there is something in the way there
    drop,      ///< the floor there is too deep
    silent     ///< the floor ought to be seen there, and nothing comes back
  };
  float x = 0.0F, y = 0.0F;  ///< [m]; of drops where the floor ought to be
  float height = 0.0F;       ///< [m] over the floor
  Kind kind = Kind::obstacle;
};

/// What one depth picture says of the floor.
struct Heights {
  bool is_blind = false;  ///< hardly anything came back
  GroundPlane ground;
  std::vector<HeightPoint> points;  ///< in the picture's order
  std::vector<Point2> floor;        ///< [m] base: where floor is seen, some pixels of each 5 cm
};

/// Parts a depth picture in floor, things in the way and drops: the plane first, then each pixel's height over it.
/// O(pixels).
class HeightFinder {
 public:
  /// @pre camera and parameters are valid
  HeightFinder(const DepthCamera& camera, const HeightParams& params, const GroundPlaneParams& ground);

  /// @pre picture has the camera's size
  [[nodiscard]] const Heights& find(const DepthPicture& picture, Rng& rng);

 private:
  void sort_pixels(const DepthPicture& picture);
  /// Pixels from one to the next that are kept of the floor in a row: across and upwards.
  [[nodiscard]] std::pair<int, int> floor_strides(int row) const;
  void add_obstacle(const DepthPicture& picture, int column, int row, float height);
  void add_drop(std::size_t pixel, float height);
  void find_silence(const DepthPicture& picture);
  [[nodiscard]] bool is_flying(const DepthPicture& picture, int column, int row) const;

  DepthCamera camera_;
  HeightParams params_;
  GroundPlaneParams ground_params_;
  DepthPoints points_;
  Heights found_;
};

}  // namespace docent::vision
