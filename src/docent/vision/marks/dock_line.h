#pragma once

#include <array>
#include <deque>
#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/vision/marks/tag_pose.h"

namespace docent::vision {

/// A camera on the robot that sees the charger's tag.
struct DockCamera {
  TagCamera lens;
  double x = 0.2, y = 0.0, z = 0.45;  ///< [m] base
  Angle pan{};                        ///< to the left
  Angle down{};                       ///< of its axis, below the horizon
};

struct DockLineParams {
  int tag = 0;                 ///< >= 0 its number
  double side = 0.16;          ///< [m] > 0 of its black square
  double height = 0.35;        ///< [m] of its middle above the floor
  double pixel = 0.6;          ///< [pixels] > 0 standard deviation of a corner, the lens's errors included
  double independent = 8.0;    ///< > 0: as many pictures as these count as measurements of their own at most
  double most_off = 2.5;       ///< [pixels] > 0: what lies farther off counts less and less
  double mount = 0.5;          ///< [deg] >= 0 standard deviation of the camera's three angles
  double height_sigma = 0.02;  ///< [m] >= 0 of the tag's height
  double odometry = 0.01;      ///< >= 0 of a way or turn, that odometry is off by: old pictures count less
  int pictures = 40;           ///< >= 2 that are kept, spread over the way
  double apart = 0.03;         ///< [m] >= 0 or as many radians * 1 m between two that are kept
  double sure = 12.0;          ///< > 0 of twice the log-likelihood by which the tag's plane is known from its mirror
  double alike = 12.0;         ///< [deg] >= 0: a mirror whose heading is so near is no other plane
  double sure_heading = 5.0;   ///< [deg] > 0 standard deviation of the heading of a line that is sure
  double least_pixels = 24.0;  ///< [pixels] > 0 side of a tag that counts
  [[nodiscard]] Result<void> validate() const;
};

/// Where to drive to dock: along a line to a place before the tag.
struct DockLineEstimate {
  Pose2 odom_from_tag;         ///< its middle on the floor; x points out of it towards who docks
  double across_sigma = 0.0;   ///< [m] standard deviation of the place across its x axis
  double heading_sigma = 0.0;  ///< [rad]
  bool is_sure = false;        ///< the tag's plane is known from its mirror
  Angle pan_error{};           ///< of the camera's mount, as far as it shows
};

/// Keeps the line to the charger in odometry's frame, from pictures of its tag: the best tag for all that were kept,
/// each from where the robot was at its stamp. A tag's plane is known to be vertical; what then remains is its place
/// and heading, and what the mount is wrong by. While the mirrored plane explains the pictures as well, it says so; a
/// line that is sure never flips: if the mirror becomes the better one by far, it is not sure any more and begins anew.
/// Deterministic.
class DockLine {
 public:
  /// @pre camera and parameters are valid
  DockLine(const DockCamera& camera, const DockLineParams& params);

  /// Odometry, in the order of its stamps.
  void add_odometry(Time stamp, const Pose2& odom_from_base);
  /// Tags of a picture, at whatever delay. Without odometry about its stamp it says nothing. @returns it was used
  bool add_tags(Time stamp, const std::vector<SeenTag>& tags);

  /// Where the tag should stand, by the map, with standard deviations [m] and of its heading [rad] > 0: of two planes
  /// that look alike it tells the right one.
  void expect(const Pose2& odom_from_tag, double place_sigma, double heading_sigma);

  /// nullopt: no tag was seen.
  [[nodiscard]] const std::optional<DockLineEstimate>& estimate() const { return estimate_; }
  /// How many pictures are kept.
  [[nodiscard]] std::size_t pictures() const { return views_.size(); }
  void forget();

 private:
  using Unknowns = Eigen::Matrix<double, 7, 1>;  // x, y, heading; errors of pan, down, roll; of the tag's height
  struct View {
    Pose2 odom_from_base;
    Point2 ahead;  ///< of length 1, odometry's frame
    std::array<Pixel, 4> corners;
    double driven = 0.0;  ///< [m] and radians up to then
  };
  struct Fit {
    Unknowns at = Unknowns::Zero();
    Eigen::Matrix<double, 7, 7> information = Eigen::Matrix<double, 7, 7>::Zero();
    double cost = 0.0;  ///< twice the negative log-likelihood
  };
  struct Expected {
    Pose2 odom_from_tag;
    double place_sigma = 1.0, heading_sigma = 1.0;
  };
  [[nodiscard]] std::optional<Pose2> odometry_at(Time stamp) const;
  [[nodiscard]] std::optional<Fit> fit(Unknowns start) const;
  [[nodiscard]] Eigen::Matrix3d camera_from_base(const Unknowns& at) const;
  [[nodiscard]] bool residuals(const Unknowns& at, const Eigen::Matrix3d& turn, const View& view,
                               Eigen::Matrix<double, 8, 1>& off) const;
  [[nodiscard]] std::optional<double> normal_equations(const Unknowns& at, Eigen::Matrix<double, 7, 7>* information,
                                                       Unknowns* slope) const;
  /// The minima about the last estimate and both poses of a tag.
  [[nodiscard]] std::vector<Fit> fits_about(const View& view, const SeenTag& tag) const;
  void keep(const View& view);
  void estimate(const View& view, const SeenTag& tag);

  DockCamera camera_;
  DockLineParams params_;
  std::deque<std::pair<Time, Pose2>> odometry_;
  std::vector<View> views_;
  double driven_ = 0.0;
  std::optional<Expected> expected_;
  std::optional<Unknowns> last_;
  std::optional<DockLineEstimate> estimate_;
};

}  // namespace docent::vision
