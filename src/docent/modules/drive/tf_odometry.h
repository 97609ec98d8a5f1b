#pragma once

#include <deque>
#include <optional>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/conversions.h"

namespace docent::modules {

struct TfOdometryParams {
  double patience = 2.0;  ///< [s] without `odom`, from the first transform on, before it is taken from there
  double window = 0.15;   ///< [s] over which the velocity is taken, which a transform does not tell
};

/// Odometry of a base that publishes none: the transform odom -> base_link (or base_footprint) of its driver. A base
/// that publishes odometry, too, is believed in that alone.
class TfOdometry {
 public:
  explicit TfOdometry(const TfOdometryParams& params = {}) : params_{params} {}

  /// Odometry was heard. @returns whether it is the one that was made here last
  bool hear(const nav_msgs::Odometry& odometry);
  /// @returns the odometry of a transform, where it is wanted
  [[nodiscard]] std::optional<nav_msgs::Odometry> take(const tf2_msgs::TFMessage& transforms, Time now);
  /// Odometry comes of transforms.
  [[nodiscard]] bool is_needed() const { return made_.has_value(); }

 private:
  struct Reading {
    Time stamp;
    Pose2 odom_from_base;
  };
  [[nodiscard]] nav_msgs::Odometry odometry_of(const geometry_msgs::TransformStamped& transform);

  TfOdometryParams params_;
  bool base_tells_ = false;  ///< it publishes odometry itself
  std::optional<Time> first_;
  std::optional<Time> made_;  ///< stamp of the newest that was made here
  std::deque<Reading> lately_;
};

}  // namespace docent::modules
