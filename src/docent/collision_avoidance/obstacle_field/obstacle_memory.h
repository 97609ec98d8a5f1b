#pragma once

#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/obstacle_field/moving_objects.h"
#include "docent/collision_avoidance/obstacle_field/range_flow.h"
#include "docent/geometry/point_transform.h"
#include "docent/geometry/polygon.h"

namespace docent {

/// One sweep of a laser scanner.
struct SensorSweep {
  Time stamp;
  Pose2 base_from_sensor;
  double first_bearing = 0.0;  ///< [rad], sensor frame
  double bearing_step = 0.0;   ///< [rad], > 0
  double min_range = 0.0;      ///< [m]
  double max_range = 0.0;      ///< [m]; this or more: nothing there
  std::vector<float> ranges;   ///< [m]; NaN: no reading
};

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

/// The obstacle field, after the obstacle line field of [Buhmann1995]: what lasers, sonars, infrared sensors, touch and
/// cameras met in the last moments, kept in the odometry's frame so that a jump of the localization never moves it
/// (architecture 10.6). Lines are kept as points, a few centimetres apart.
///
/// What the newest sweep of a sensor looks through still counts while it is one of the last three: a beam may pass a
/// chair's leg. Not so what moves, which is where the newest sweep meets it. Where a sweep cannot
/// look, behind something nearer or where a beam gave no reading, points live on for kMemory. A lone reading (dust,
/// cross talk) counts from the second sweep on.
class ObstacleMemory {
 public:
  static constexpr double kMemory = 1.5;         ///< [s]
  static constexpr double kTouchMemory = 60.0;   ///< [s] of a touch by what no laser sees: nothing tells of it again
  static constexpr double kReach = 6.0;          ///< [m] from the robot; what is farther does not matter yet
  static constexpr double kSonarReach = 1.5;     ///< [m]
  static constexpr double kInfraredReach = 0.7;  ///< [m]
  static constexpr int kSweeps = 3;              ///< of each sensor that count
  static constexpr double kLineStep = 0.05;      ///< [m] between the points of a line
  static constexpr double kLongestLife = 5.0;    ///< [s] of a camera's lines

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
  /// The body was touched at `in_base` (on its outline). Counts for 0.3 s where a laser sees who touches: whether they
  /// are still there, the laser tells; for kMemory where a laser sees somebody near; for kTouchMemory where none does.
  void add_touch(Time stamp, Point2 in_base, const Pose2& odom_from_base);
  /// The body stands here, odometry's frame: nothing that touched it is within `radius` [m]. Wheels that slip against a
  /// thing carry the odometry through it.
  void stand(Point2 in_odom, double radius);
  /// Where something that no laser sees touched the body in the last kTouchMemory [s]: places [m] in odometry's frame.
  [[nodiscard]] std::vector<Point2> touched_things(Time now) const;

  /// Everything that counts at `now`, moving things where they are by now.
  [[nodiscard]] std::vector<ObstaclePoint> points(Time now) const;
  /// Directions in the base frame [rad] where a laser should look but gave nothing over more than 6 degrees.
  [[nodiscard]] std::vector<double> blind_directions() const;
  [[nodiscard]] const MovingObjects& moving_objects() const { return moving_; }

  /// True when the sensor has given the very same ranges although the base moved.
  [[nodiscard]] bool is_frozen(std::size_t sensor) const;
  /// Share of the newest sweep's beams that gave no reading.
  [[nodiscard]] double invalid_share(std::size_t sensor) const;

 private:
  struct Sensor {
    SensorSweep sweep;
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
  void watch_for_freeze(Sensor& sensor, const SensorSweep& sweep, const Pose2& odom_from_base) const;
  /// True for points that have a neighbour in their own sweep or lie where the sweep before had one.
  [[nodiscard]] static std::vector<bool> confirm(std::span<const Point2> points, std::span<const int> beams,
                                                 std::span<const ObstaclePoint> before);
  /// Where something comes nearer that is not followed, or faster than what is followed there.
  static void let_come_nearer(Sensor& sensor, std::span<const Point2> places, std::span<const int> beams);
  enum class View { hidden, met_again, looked_through };
  [[nodiscard]] static View view_of(const Sensor& sensor, const PointTransform& sensor_from_odom, Point2 in_odom);

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

}  // namespace docent
