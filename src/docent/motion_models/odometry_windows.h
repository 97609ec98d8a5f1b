#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::motion_models {

/// Symmetric 3 x 3 matrix over (x [m], y [m], heading [rad]).
struct Symmetric3 {
  double xx = 0.0, xy = 0.0, xt = 0.0, yy = 0.0, yt = 0.0, tt = 0.0;
  void add(double scale, const Symmetric3& other);
};

/// What an error of odometry or of a pose label is made of. Variances of a window are linear in these.
enum NoiseSource : std::size_t {
  translation_per_metre,
  translation_per_radian,
  rotation_per_metre,
  rotation_per_radian,
  label_position,  ///< of each of the two labels, along each axis
  label_heading,
  kNoiseSources
};

/// A piece of way over which odometry is compared with pose labels.
struct MotionWindow {
  double way = 0.0;             ///< [m]
  double turn = 0.0;            ///< [rad], sum of all turns
  double exposure = 0.0;        ///< steps in which wheels may slip
  std::array<double, 3> error;  ///< x, y [m], heading [rad]: the labelled end seen from where odometry puts it
  std::array<Symmetric3, kNoiseSources> unit;  ///< covariance of the error for one unit of each source
  Symmetric3 slip;                             ///< covariance that one slip somewhere on the way adds
};

/// Compares `odom_from_robot` (a pose a step, the first at the window's start) with the labelled motion
/// `start_from_end`. Errors of early headings grow with the way that follows, to first order. O(steps). @pre at least
/// two poses
[[nodiscard]] MotionWindow motion_window(std::span<const Pose2> odom_from_robot, const Pose2& start_from_end);

/// A moment of a recording with odometry and perhaps a label.
struct LabelledOdometry {
  Pose2 odom_from_robot;
  Pose2 map_from_robot;
  bool sure = false;  ///< the label counts
};

struct MotionWindowParams {
  std::vector<double> lengths{0.5, 1.0, 2.0, 5.0};  ///< [m] of way; a radian turned counts half a metre
  double stride = 0.5;                              ///< [m] between the starts of windows
  double step_way = 0.25;                           ///< [m]: steps are so long, as between updates of a localizer, or
  double step_turn = 10.0;                          ///< [deg]
};
/// All windows of the given lengths that begin and end at sure labels. `first` and `last` of the result say which
/// moments. O(moments * lengths).
struct PlacedWindow {
  MotionWindow window;
  std::size_t first = 0, last = 0;  ///< moments
};
[[nodiscard]] std::vector<PlacedWindow> motion_windows(std::span<const LabelledOdometry> moments,
                                                       const MotionWindowParams& params = {});

}  // namespace docent::motion_models
