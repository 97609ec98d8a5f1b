#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstddef>
#include <optional>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/angle.h"

namespace docent::vision {

/// A picture of distances along the camera's axis.
struct DepthPicture {
  int columns = 0;
  int rows = 0;
  std::vector<float> depth;  ///< [rows * columns] [m] from the top left; 0: nothing came back

  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// Where a camera sits on the robot: base frame, x to the front, y to the left, z up from the floor.
struct DepthCameraMount {
  double x = 0.0;  ///< [m]
  double y = 0.0;  ///< [m]
  double z = 1.0;  ///< [m] above the floor
  Angle pan{};     ///< to the left
  Angle down{};    ///< of its axis, below the horizon
  Angle roll{};    ///< about its axis, clockwise as the camera sees it
};

/// A pinhole without distortion on its mount. Camera frame: x to the right, y down, z along the axis.
struct DepthCamera {
  int columns = 320;
  int rows = 240;
  double focal = 292.5;     ///< [pixels]
  double centre_x = 160.0;  ///< [pixels] of the axis; the centre of the first pixel is 0
  double centre_y = 120.0;
  DepthCameraMount mount;

  [[nodiscard]] Result<void> validate() const;
  /// Columns: the camera's x, y, z in the base frame.
  [[nodiscard]] Eigen::Matrix3d base_from_camera() const;
  [[nodiscard]] Eigen::Vector3d position() const { return {mount.x, mount.y, mount.z}; }  ///< [m], base
  /// Of length 1 along the axis, base frame.
  [[nodiscard]] Eigen::Vector3d ray(double column, double row) const;
};

/// Where a point of the base frame stands in the picture.
struct PicturePlace {
  double column = 0.0, row = 0.0;  ///< [pixels]
  double depth = 0.0;              ///< [m] along the axis
};

/// Projects many points of the base frame.
class Projector {
 public:
  explicit Projector(const DepthCamera& camera);
  /// nullopt: behind the camera or outside the picture.
  [[nodiscard]] std::optional<PicturePlace> place_of(const Eigen::Vector3d& in_base) const;

 private:
  DepthCamera camera_;
  Eigen::Matrix3d camera_from_base_;
  Eigen::Vector3d position_;
};

/// All pixels' points in the base frame, one array a coordinate: structure of arrays for the loops over all of them.
struct DepthPoints {
  std::vector<float> x, y, z;  ///< [rows * columns] [m], of pixels without depth anything
  /// @pre picture has the camera's size
  void fill(const DepthCamera& camera, const DepthPicture& picture);
};

/// Standard deviation of a structured-light camera's depth [m] at a depth [m], as Nguyen, Izadi and Lovell measured a
/// Kinect (2012).
[[nodiscard]] inline float depth_noise(float depth) { return 0.0012F + 0.0019F * (depth - 0.4F) * (depth - 0.4F); }

}  // namespace docent::vision
