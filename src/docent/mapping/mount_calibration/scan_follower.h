#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "docent/mapping/mount_calibration/calibration_params.h"
#include "docent/mapping/mount_calibration/motion_pairs.h"
#include "docent/mapping/scan_matching/surface_index.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::mapping {

/// Lays the sweeps of one scanner onto one another while the robot drives. It needs no map, and no other scanner: what
/// it sees of the motion is in the sensor's own frame.
class ScanFollower {
 public:
  explicit ScanFollower(const ScanFollowerParams& params) : params_{params} {}

  /// A sweep waits until odometry tells where the robot was for some time after it. @param stamp  the scanner's own
  void keep(Time stamp, const sensor_models::LaserReading& reading);
  /// What came of the sweeps that waited. @param mount  as it is believed to be, to guess where a sweep lies
  /// @param way  [m] that makes a pair
  /// O(sweeps that are worth it * points)
  [[nodiscard]] std::vector<MotionPair> follow(const motion_models::OdometryHistory& odometry, const Pose2& mount,
                                               double way);
  /// Nothing holds over a jump of the odometry, or where the robot is carried.
  void forget();

 private:
  struct Waiting {
    Time stamp{};
    sensor_models::LaserReading reading;  ///< without its ranges
    std::vector<float> ranges;            ///< [m]
  };
  struct Reference {
    Time stamp{};
    std::vector<SurfacePoint> points;
    std::optional<SurfaceIndex> surfaces{};  ///< of these, once a sweep is to be laid onto them
  };
  [[nodiscard]] std::vector<SurfacePoint> points_of(Waiting& sweep) const;
  [[nodiscard]] bool is_worth_it(const Pose2& moved) const;
  void begin(Time stamp, const std::vector<SurfacePoint>& points);
  /// Of the reference and the last sweep that lay on it, if they are so far apart.
  [[nodiscard]] std::optional<MotionPair> pair_of_last(const motion_models::OdometryHistory& odometry, double way,
                                                       double turn) const;
  [[nodiscard]] std::optional<MotionPair> look(const motion_models::OdometryHistory& odometry, const Pose2& mount,
                                               double way);

  ScanFollowerParams params_;
  std::deque<Waiting> waiting_;
  std::optional<Reference> reference_;
  Time last_{};                                            ///< stamp of the last sweep that was looked at
  Pose2 reference_from_last_;                              ///< by the scans
  Eigen::Matrix3d information_ = Eigen::Matrix3d::Zero();  ///< of that
};

}  // namespace docent::mapping
