#pragma once

#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/obstacle_field/moving_objects.h"
#include "docent/collision_avoidance/obstacle_field/range_flow.h"
#include "docent/collision_avoidance/obstacle_field/straight_pieces.h"
#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"
#include "docent/geometry/point_transform.h"
#include "docent/geometry/polygon.h"

namespace docent::collision_avoidance {

/// One sweep of a laser scanner.
struct SensorSweep {
  Time stamp;
  Pose2 base_from_sensor;
  double first_bearing = 0.0;    ///< [rad], sensor frame
  double bearing_step = 0.0;     ///< [rad], > 0
  double min_range = 0.0;        ///< [m]
  double max_range = 0.0;        ///< [m]; this or more: nothing there
  std::vector<float> ranges;     ///< [m]; NaN: no reading
  double late = 0.0;             ///< [s] by which the stamp is later than the sweep, by what was learned of the scanner
  std::vector<bool> own_body{};  ///< [beams] those that end on the robot itself, which give no reading; empty: none
};

[[nodiscard]] inline bool is_own_body(const SensorSweep& sweep, std::size_t beam) {
  return beam < sweep.own_body.size() && sweep.own_body[beam];
}

/// One reading of a sonar, or of an infrared sensor.
struct SonarReading {
  Time stamp;
  Pose2 base_from_sensor;
  double field_of_view = 0.0;  ///< [rad]
  double max_range = 0.0;      ///< [m]
  double range = 0.0;          ///< [m]; NaN: no reading
};

/// A point that a sensor met, in the odometry's frame.
struct ObstaclePoint {
  Point2 in_odom;     ///< [m]
  Point2 velocity{};  ///< [m/s] of the moving thing it belongs to
  Time seen;
  bool person = false;    ///< slim and free-standing, or comes nearer amid a throng: likely a person
  bool straight = false;  ///< part of a long straight piece: nobody
  bool confirmed = true;  ///< false: a lone reading that the sweep before knew nothing of; does not count yet
  int missed = 0;         ///< later sweeps that looked through it
  bool low = false;       ///< met by a sonar, an infrared sensor or touch, and by no laser: a thing, that stays
};

/// Who touched the body: what a laser sees, perhaps somebody whom a laser sees near, or a thing that no laser sees.
enum class TouchedBy { seen, somebody, thing };

/// How long and how far what was met counts.
struct ObstacleMemoryParams {
  MovingObjectsParams moving{};
  RangeFlowParams flow{};
  StraightPiecesParams straight{};
  // Lasers.
  double memory = 1.5;           ///< [s] points live on where no sweep can look
  double reach = 6.0;            ///< [m] from the robot; what is farther does not matter yet
  int sweeps = 3;                ///< of each sensor that count
  double blind_gap = 0.105;      ///< [rad] 6 degrees without a reading: a leg could stand there
  double neighbour = 0.2;        ///< [m] between two readings of one sweep that bear each other out
  double again = 0.25;           ///< [m] likewise of one sweep and the one before
  double same = 0.15;            ///< [m] a reading so near to a point has met it again
  double foreseen = 0.5;         ///< [s] that what moves is carried on at most
  double more_than_known = 0.5;  ///< [m/s] faster than who is followed there: two were taken for one
  // Frozen lasers.
  int frozen_sweeps = 2;      ///< repeats: noise alone makes even one unlikely
  int frozen_hits = 3;        ///< beams that met something: fewer prove nothing
  int frozen_readings = 9;    ///< noisy readings that were all repeated
  double frozen_way = 0.015;  ///< [m] that the base has driven meanwhile
  double frozen_turn = 0.02;  ///< [rad] or turned
  // Sonars and infrared sensors.
  double sonar_reach = 1.5;      ///< [m] farther echoes are of anything
  double infrared_reach = 0.7;   ///< [m] farther readings are of anything
  double echo_again = 0.2;       ///< [m] between two echoes that bear each other out
  double echo_time = 1.0;        ///< [s] likewise
  double least_cone = 0.13;      ///< [rad] a ring's places and axes are known no better
  double explained = 0.25;       ///< [m] beyond the echo, to where a laser's point is what the sensor heard
  double explained_cones = 2.0;  ///< from the axis likewise: half a cone more to each side
  // Cameras.
  double line_step = 0.05;     ///< [m] between the points of a line
  double longest_line = 20.0;  ///< [m] more is no line on a floor
  double longest_life = 5.0;   ///< [s] of a camera's lines
  // Touch.
  double touch_memory = 60.0;  ///< [s] of a touch by what no laser sees: nothing tells of it again
  double seen_touch = 0.3;     ///< [s] of a touch by what a laser sees: from then on the laser knows better
  double touched = 0.15;       ///< [m] a laser's point so near to a touch is what touches
  double by_somebody = 0.4;    ///< [m] who stood here in the last sweep may have walked into the robot
  double same_touch = 0.01;    ///< [m] who goes on touching says the same again
};

/// The obstacle field, after the obstacle line field of [Buhmann1995]: what lasers, sonars, infrared sensors, touch and
/// cameras met in the last moments, kept in the odometry's frame so that a jump of the localization never moves it
/// (architecture 10.6). Lines are kept as points, a few centimetres apart.
///
/// What the newest sweep of a sensor looks through still counts while it is one of the last three: a beam may pass a
/// chair's leg. Not so what moves, which is where the newest sweep meets it. Where a sweep cannot
/// look, behind something nearer or where a beam gave no reading, points live on for a while. A lone reading (dust,
/// cross talk) counts from the second sweep on.
class ObstacleMemory {
 public:
  explicit ObstacleMemory(const ObstacleMemoryParams& params = {}) : params_{params}, moving_{params.moving} {}

  /// @param odom_from_base  pose at the sweep's stamp. Sensors are numbered from 0.
  void add_sweep(std::size_t sensor, const SensorSweep& sweep, const Pose2& odom_from_base);
  /// A sonar echo counts when two readings in a row agree and no laser point explains it (a laser looks through glass
  /// and over low things).
  void add_sonar(std::size_t index, const SonarReading& reading, const Pose2& odom_from_base);
  /// Likewise: an infrared sensor sees low things, and what sound slides off.
  void add_infrared(std::size_t index, const SonarReading& reading, const Pose2& odom_from_base);
  /// What a camera saw on the floor; replaces what it saw before. The lines count for `lifetime` [s] after their stamp.
  void add_lines(const std::string& source, Time stamp, double lifetime, std::span<const Segment> in_base,
                 const Pose2& odom_from_base);
  /// The body was touched at `in_base` (on its outline). Counts for a moment where a laser sees who touches: whether
  /// they are still there, the laser tells; as long as points live where a laser sees somebody near; for a minute where
  /// none does.
  /// @returns who touched, as far as the lasers tell
  TouchedBy add_touch(Time stamp, Point2 in_base, const Pose2& odom_from_base);
  /// The body stands here, odometry's frame: nothing that touched it is within `radius` [m]. Wheels that slip against a
  /// thing carry the odometry through it.
  void stand(Point2 in_odom, double radius);
  /// Where something that no laser sees touched the body in the last minute: places [m] in odometry's frame.
  [[nodiscard]] std::vector<Point2> touched_things(Time now) const;

  /// Everything that counts at `now`, moving things where they are by now.
  [[nodiscard]] std::vector<ObstaclePoint> points(Time now) const;
  /// Directions in the base frame [rad] where a laser should look but gave nothing over more than a gap.
  [[nodiscard]] std::vector<double> blind_directions() const;
  [[nodiscard]] const MovingObjects& moving_objects() const { return moving_; }

  /// True when the sensor has given the very same ranges although the base moved.
  [[nodiscard]] bool is_frozen(std::size_t sensor) const;
  /// Share of the newest sweep's beams that gave no reading.
  [[nodiscard]] double invalid_share(std::size_t sensor) const;

 private:
  struct Sensor {
    SensorSweep sweep;
    BeamDirections directions;
    Pose2 odom_from_sensor;
    std::vector<ObstaclePoint> points;      ///< of the newest sweep
    std::vector<ObstaclePoint> remembered;  ///< of earlier ones
    std::vector<double> blind;              ///< [rad], base frame
    RangeFlow flow;
    double invalid_share = 0.0;
    Pose2 odom_from_base_at_change;  ///< where the base was when the ranges last changed
    int repeats = 0;
    bool frozen = false;
  };
  struct Echo {
    Point2 in_odom;
    Time stamp;
    bool valid = false;
  };
  /// Sensors all round the body that measure one distance each.
  struct Ring {
    std::vector<Echo> last;  ///< of each sensor
    std::deque<ObstaclePoint> points;
  };
  struct CameraView {
    std::vector<ObstaclePoint> points;
    Time until;
  };
  void add_echo(Ring& ring, double reach, std::size_t index, const SonarReading& reading, const Pose2& odom_from_base);
  /// What the beams of a sweep met: places [m], odom; ranges [m]; numbers of the beams, rising.
  struct Readings {
    std::vector<Point2> places;
    std::vector<double> ranges;
    std::vector<int> beams;
  };
  /// Also finds where the sensor is blind, and how much of its sweep is none.
  [[nodiscard]] Readings read(Sensor& sensor) const;
  /// Makes points of the readings and leaves those that are borne out in `readings`. @returns the lone ones
  [[nodiscard]] std::vector<ObstaclePoint> keep_confirmed(Sensor& sensor, Readings& readings,
                                                          std::span<const ObstaclePoint> before) const;
  void mark_what_moves(Sensor& sensor, const Readings& readings);
  /// Drops earlier points that are too old, were met again, or were looked through.
  void revise_remembered(Sensor& sensor) const;
  void watch_for_freeze(Sensor& sensor, const SensorSweep& sweep, const Pose2& odom_from_base) const;
  /// True for points that have a neighbour in their own sweep or lie where the sweep before had one.
  [[nodiscard]] std::vector<bool> confirm(std::span<const Point2> points, std::span<const int> beams,
                                          std::span<const ObstaclePoint> before) const;
  /// Where something comes nearer that is not followed, or faster than what is followed there.
  void let_come_nearer(Sensor& sensor, const Readings& readings) const;
  enum class View { hidden, met_again, looked_through };
  [[nodiscard]] View view_of(const Sensor& sensor, const PointTransform& sensor_from_odom, Point2 in_odom) const;

  ObstacleMemoryParams params_;
  std::vector<Sensor> sensors_;
  Ring sonars_;
  Ring infrareds_;
  std::map<std::string, CameraView> cameras_;
  struct Touch {
    ObstaclePoint point;
    Time until;
  };
  std::vector<Touch> touches_;
  MovingObjects moving_;
};

}  // namespace docent::collision_avoidance
