#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/vision/depth/heights.h"

namespace docent::vision {

struct DepthLayerParams {
  double cell = 0.05;         ///< [m] > 0 side of a column
  double side = 8.0;          ///< [m] > cell of the square that moves along with the robot
  double body_radius = 0.25;  ///< [m] >= 0 about the base: where the robot stands, nothing else does
  double hit = 0.7;           ///< > 0 log-odds of a picture that shows something there
  double pass = 0.9;          ///< > 0 of one that sees through there
  double unanswered =
      0.25;           ///< >= 0 of one whose rays through there do not come back, though what stood there answered
  double most = 3.5;  ///< > 0 to which they grow: what has gone is forgotten in most / pass pictures
  double silent_floor = 0.35;  ///< >= 0 of a picture in which the floor there does not answer
  double occupied = 1.0;       ///< > 0 from which on it counts
  int least_pixels = 3;        ///< >= 1 of a column that a picture must show
  [[nodiscard]] Result<void> validate() const;
};

/// A column that is in the way.
struct LayerCell {
  Point2 centre;         ///< [m] odometry's frame
  bool is_drop = false;  ///< the floor is missing there
};

/// What depth pictures have shown, about the robot, in odometry's frame: columns of voxels with log-odds of something
/// in the way, and log-odds of a missing floor. Voxels are freed only by rays that are seen to go through them, so that
/// a table's edge stays when the robot looks below it; and all of the picture frees, while its border marks nothing. A
/// drop is freed only by floor that is seen in its place: silence never does, nor time. What the square leaves behind
/// is forgotten. O(pixels + voxels in the way).
class DepthLayer {
 public:
  /// @pre camera and parameters are valid
  DepthLayer(const DepthCamera& camera, const DepthLayerParams& params, double low, double robot_height);

  /// @param odom_from_base  when the picture was taken
  void add(const DepthPicture& picture, const Heights& heights, const Pose2& odom_from_base);

  /// In the order of rows and columns of the square.
  [[nodiscard]] std::vector<LayerCell> cells() const;

 private:
  static constexpr int kStoreys = 8;  // voxels of a column
  struct Column {
    std::array<float, kStoreys> odds{};  ///< of something in the way, log-odds >= 0
    std::array<float, kStoreys> at{};    ///< [m] over the floor where it was seen last
    float drop = 0.0F;                   ///< of a missing floor, log-odds >= 0
  };
  /// What the present picture shows in a column.
  struct Shown {
    std::array<std::uint16_t, kStoreys> hits{};
    std::array<float, kStoreys> heights{};  ///< [m] sums
    std::uint16_t drops = 0, silent = 0, floor = 0;
    bool is_touched = false;
  };
  /// In the ring; of the square's cells alone.
  [[nodiscard]] int slot(int column, int row) const {
    const int x = column - first_column_ + ring_column_, y = row - first_row_ + ring_row_;
    return (y >= cells_ ? y - cells_ : y) * cells_ + (x >= cells_ ? x - cells_ : x);
  }
  void note(int slot);  ///< after a change of a column
  [[nodiscard]] bool holds(int column, int row) const {
    return column >= first_column_ && row >= first_row_ && column < first_column_ + cells_ && row < first_row_ + cells_;
  }
  /// The next whole number below, without a call.
  [[nodiscard]] int index_of(double coordinate) const {
    const double at = coordinate / params_.cell;
    const int towards_zero = static_cast<int>(at);
    return towards_zero - (at < towards_zero ? 1 : 0);
  }
  void move_to(Point2 odom);
  void count(const Heights& heights);
  Shown* shown_at(float x, float y);
  void raise();
  void clear(const DepthPicture& picture, const Heights& heights, const Pose2& odom_from_base);
  [[nodiscard]] float seen_through(const DepthPicture& picture, const PicturePlace& place) const;
  void free_body(Point2 odom);

  DepthCamera camera_;
  Projector projector_;
  DepthLayerParams params_;
  double low_;
  double storey_;                         ///< [m]
  int cells_;                             ///< of a side
  int first_column_ = 0, first_row_ = 0;  ///< of the square, in cells from the frame's origin
  int ring_column_ = 0, ring_row_ = 0;    ///< where these lie in the ring
  Point2 place_, ahead_{1.0, 0.0};        ///< of the base at the present picture
  bool is_placed_ = false;
  std::vector<Column> columns_;   ///< [cells² ], a ring both ways
  std::vector<float> strongest_;  ///< likewise: the most of a column's log-odds, which loops over all look at
  std::vector<Shown> shown_;      ///< likewise
  std::vector<int> touched_;      ///< of shown_
};

}  // namespace docent::vision
