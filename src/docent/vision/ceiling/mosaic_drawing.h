#pragma once

#include <optional>
#include <vector>

#include "docent/vision/ceiling/ceiling_camera.h"
#include "docent/vision/ceiling/ceiling_mosaic.h"

namespace docent::vision {

/// A picture with the pose at which it was taken, and its light: what the camera shows is gain * ceiling + offset.
struct PlacedPicture {
  GrayPicture picture;
  Pose2 map_from_robot;
  double gain = 1.0;                       ///< > 0
  double offset = 0.0;                     ///< of 0 .. 1
  std::optional<Pose2> odom_from_robot{};  ///< where odometry had the robot then
};

/// Puts pictures together to a mosaic: each cell is the mean of what the pictures show of it, those from beneath count
/// most. Cells that none shows become unknown.
class MosaicDrawing {
 public:
  /// @param mosaic    frame, heights and parts; brightness is not read
  /// @param steepest  farthest look, as a slope
  MosaicDrawing(CeilingMosaic mosaic, const CeilingCamera& camera, double steepest);
  void add(const PlacedPicture& placed);
  /// What was added up to now.
  [[nodiscard]] CeilingMosaic mosaic() const;

 private:
  void add_part(const PlacedPicture& placed, std::size_t part);

  CeilingMosaic parts_;
  CeilingCamera camera_;
  double steepest_;
  std::vector<float> sums_;
  std::vector<float> weights_;
};

/// A ceiling of lamps on a grid, all alike, bright on dark.
struct LampGrid {
  double step_x = 3.0;    ///< [m] from lamp to lamp, > 0
  double step_y = 3.0;    ///< [m] > 0
  double length_x = 0.3;  ///< [m] of a lamp
  double length_y = 1.2;  ///< [m]
  double height = 2.5;    ///< [m] above the floor
};
/// A lamp's centre lies at the map's origin.
[[nodiscard]] CeilingMosaic mosaic_of(const LampGrid& lamps, const GridFrame& frame);

}  // namespace docent::vision
