#pragma once

#include <optional>
#include <vector>

#include "docent/base/result.h"
#include "docent/localization/sonar/tracker/drift_filter.h"
#include "docent/localization/sonar/tracker/echo_map.h"
#include "docent/localization/sonar/tracker/sweep_match.h"
#include "docent/localization/sonar/tracker/wall_angles.h"

namespace docent::localization {

struct SonarTrackerParams {
  motion_models::OdometryModelParams motion{4e-4, 1e-4, 2e-4, 1e-3, 0.0};
  OdometryDriftParams drift;
  WallAngleParams walls;
  SweepMatchParams match;
  bool use_walls = true;      ///< compare headings of walls with the building's
  bool use_matches = true;    ///< match sweeps to the map
  double sweep_length = 1.0;  ///< [m], > 0: way on which a sweep is gathered
  double sweep_turn = 60.0;   ///< [deg], > 0: or turn
  int sweep_echoes = 150;     ///< >= 15: of a sweep at most; more are thinned evenly
  double rectangular = 0.5;   ///< 0..1: share of aligned walls from which a building has main directions
  template <class V>
  void visit(V& v) {
    v("motion", motion);
    v("drift", drift);
    v("walls", walls);
    v("match", match);
    v("use_walls", use_walls);
    v("use_matches", use_matches);
    v("sweep_length", sweep_length);
    v("sweep_turn", sweep_turn);
    v("sweep_echoes", sweep_echoes);
    v("rectangular", rectangular);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A reading of one sonar.
struct SonarEcho {
  int sonar = 0;
  Pose2 robot_from_sonar;
  double range = 0.0;      ///< [m]; at or beyond max_range: nothing heard
  double max_range = 5.0;  ///< [m]
};

/// Position control of a robot that has sonars only [Buhmann1995]: odometry, corrected by sweeps matched to the map and
/// by the angles of walls in buildings that are mostly rectangular. Tracks from a known start: it does not find itself.
/// A Kalman filter; systematic errors of odometry are learned on the way.
class SonarTracker {
 public:
  SonarTracker(const OccupancyGrid& map, const SonarTrackerParams& params, int sonars);

  /// @param position [m], heading [rad]: standard deviations
  void start_at(const Pose2& map_from_robot, double position, double heading);
  /// An odometry reading. The first only tells where odometry stands.
  void move(const Pose2& odom_from_robot);
  /// @param odom_from_robot  where odometry stood at the ping, at most a second ago. Before the first move: no effect.
  void hear(const SonarEcho& echo, const Pose2& odom_from_robot);

  [[nodiscard]] const Pose2& map_from_robot() const { return filter_.map_from_robot(); }
  [[nodiscard]] PoseMatrix covariance() const { return filter_.covariance(); }
  [[nodiscard]] const DriftFilter& filter() const { return filter_; }
  [[nodiscard]] const EchoMap& map() const { return map_; }

  struct Tally {
    int matched = 0, too_few = 0, unlike = 0, ambiguous = 0, too_far = 0;
    int walls = 0, walls_refused = 0;
  };
  [[nodiscard]] const Tally& tally() const { return tally_; }
  /// Sweeps in a row that contradicted the pose: unlike the map, or too far off. From some five on, it may be lost.
  [[nodiscard]] int contradictions() const { return contradictions_; }
  /// A guess that grows with the contradictions; not calibrated.
  [[nodiscard]] double p_lost() const;

 private:
  struct Heard {
    Pose2 track_from_sonar;
    double range;
  };
  void use_wall(const WallAngle& wall);
  void match_now();

  SonarTrackerParams params_;
  EchoMap map_;
  DriftFilter filter_;
  WallAngles walls_;
  std::optional<Pose2> odom_from_robot_;
  Pose2 track_from_robot_;  ///< odometry without its systematic errors; nothing else moves it
  double way_ = 0.0;        ///< [m] since
  double turn_ = 0.0;       ///< [rad] since
  std::vector<Heard> sweep_;
  Tally tally_;
  int contradictions_ = 0;
};

}  // namespace docent::localization
