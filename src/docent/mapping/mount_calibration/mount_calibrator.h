#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "docent/mapping/mount_calibration/calibration_params.h"
#include "docent/mapping/mount_calibration/mount_fit.h"
#include "docent/mapping/mount_calibration/scan_follower.h"
#include "docent/mapping/mount_calibration/turning_side.h"
#include "docent/motion_models/odometry_history.h"
#include "docent/motion_models/unbroken_odometry.h"

namespace docent::mapping {

/// A scanner as robot.yaml has it.
struct NominalScanner {
  std::string name;
  Pose2 base_from_sensor;
  bool is_upside_down = false;  ///< it is said to hang, and its sweeps come here turned over
};

/// What of a scanner contradicts robot.yaml, beyond doubt.
struct Contradictions {
  bool is_turned = false;
  bool is_displaced = false;
  bool is_late = false;
  bool operator==(const Contradictions&) const = default;
};

/// What is known of a scanner.
struct CalibratedScanner {
  MountEstimate estimate;
  std::size_t pairs = 0;        ///< that it comes of
  bool is_known = false;        ///< the errors of heading and place are small
  bool is_settled = false;      ///< and so small that a look now and then will do
  bool is_borne_out = false;    ///< what is to be used fits the drive so far: no reason to be slow any more
  Contradictions named{};       ///< robot.yaml says otherwise
  Pose2 base_from_sensor;       ///< to be used: as robot.yaml has it, or as it was found
  double delay = 0.0;           ///< [s] to be used
  double doubt_heading = 0.0;   ///< [rad] standard deviation of what is to be used
  double doubt_position = 0.0;  ///< [m] likewise
  std::string finding;          ///< what contradicts robot.yaml, in words; empty: nothing
  MountEstimate told;           ///< that the words are of: who is told anew with every sweep listens no more
};

/// The base as the scanners see it.
struct CalibratedBase {
  double way_scale = 1.0, turn_scale = 1.0;
  double way_sigma = 1.0, turn_sigma = 1.0;
  std::string finding;
};

/// By how much an estimate differs from robot.yaml, its standard deviation, and what is named at least; in one unit.
struct Deviation {
  double value = 0.0;
  double sigma = 0.0;
  double limit = 0.0;
};

/// Whether an estimate of so many pairs contradicts robot.yaml. `misfit`: see MountEstimate. Where most of what a
/// scanner sees walks along, half of the pairs contradict any estimate: then many pairs must have it beyond doubt.
[[nodiscard]] bool is_named(const Deviation& off, std::size_t pairs, double misfit,
                            const MountCalibratorParams& params);

/// Finds out, while the robot drives, where its scanners are mounted and how late their stamps are, and what its
/// odometry is worth. Each scanner by itself, from the motion that it sees: neither map nor belief is asked, which a
/// wrong mount spoils. Deterministic; knows no wall clock.
class MountCalibrator {
 public:
  MountCalibrator(const MountCalibratorParams& params, std::vector<NominalScanner> scanners);

  void move(Time stamp, const Pose2& odom_from_base);
  void see(std::size_t scanner, Time stamp, const sensor_models::LaserReading& reading);
  /// Looks at what came. @returns whether anything that is to be used, or is said, may have changed.
  /// O(sweeps * points + pairs)
  bool work();

  /// What was found before the robot was started anew: it holds until the scanners say otherwise.
  void remember(std::size_t scanner, const MountEstimate& estimate, std::size_t pairs);

  [[nodiscard]] const std::vector<CalibratedScanner>& scanners() const { return results_; }  ///< [scanners]
  [[nodiscard]] const std::vector<NominalScanner>& nominal() const { return nominal_; }      ///< [scanners]
  [[nodiscard]] CalibratedBase base() const;
  /// Mounts are not known, and it may be that a few metres more will tell.
  /// A scanner that mirrors left and right slows it down for ever.
  [[nodiscard]] bool is_slow() const { return is_mirrored() || (!is_released_ && way_ < params_.unknown_way); }
  [[nodiscard]] bool is_known() const;        ///< all mounts are
  [[nodiscard]] bool is_mirrored() const;     ///< some scanner's left and right are, see TurningSide
  [[nodiscard]] std::string finding() const;  ///< all that contradicts robot.yaml, in words; empty: nothing

 private:
  struct Follower {
    ScanFollower sweeps;
    TurningSide turning;
    std::deque<MotionPair> pairs;
    MountPrior prior;
    std::size_t remembered = 0;  ///< pairs that the prior comes of
    std::size_t unfitted = 0;    ///< pairs since the last fit
    double rest_way = 0.0;       ///< [m] and
    double rest_turn = 0.0;      ///< [rad] that it drives before the next look
  };
  void fit(std::size_t scanner);
  void rest(Follower& follower) const;
  [[nodiscard]] static bool rests(const Follower& follower) {
    return follower.rest_way > 0.0 && follower.rest_turn > 0.0;
  }
  /// A clock was set, or a driver stamps otherwise than before: the mount is as it was, the delay is another one.
  void forget_delay(Follower& follower, const MountEstimate& estimate) const;
  /// @returns whether it did: the mount is not where it was
  bool forget_old(Follower& follower, const MountEstimate& before) const;
  void judge(std::size_t scanner);
  [[nodiscard]] bool is_borne_out(const CalibratedScanner& scanner) const;

  MountCalibratorParams params_;
  std::vector<NominalScanner> nominal_;
  std::vector<Follower> followers_;
  std::vector<CalibratedScanner> results_;
  double way_ = 0.0;          ///< [m] that it has driven
  bool is_released_ = false;  ///< the drive has borne out all mounts, and nothing was knocked since
  motion_models::UnbrokenOdometry unbroken_{motion_models::BaseReach::of_any()};
  motion_models::OdometryHistory odometry_{std::chrono::seconds{6}};
};

}  // namespace docent::mapping
