#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "docent/simulator/body/battery.h"
#include "docent/simulator/body/body.h"
#include "docent/simulator/hardware.h"
#include "docent/simulator/physique/slice.h"
#include "docent/simulator/scenario/scenario.h"
#include "docent/simulator/sensing/infrared.h"
#include "docent/simulator/sensing/laser.h"
#include "docent/simulator/sensing/scanner_lies.h"
#include "docent/simulator/sensing/sonar.h"
#include "docent/simulator/transport/wire.h"
#include "docent/transport/bus.h"

namespace docent::simulator {

/// The robot's sensors and their faults: measures the world and publishes what a driver of real hardware would.
class Instruments {
 public:
  /// The bus must outlive this, or die with nothing scheduled.
  Instruments(transport::Bus& bus, const World& world, const Hardware& hardware, const Rng& rng);

  void change_world(const World& world);
  /// The lasers look no farther than `range` [m] from now on.
  void limit_reach(double range) {
    for (Scanner& scanner : scanners_) scanner.laser.limit_reach(range);
  }
  void set_fault(const SensorFault& fault, Time now);
  /// Of a laser that the robot has, from now on.
  void set_lie(const ScannerLie& lie, Time now);
  /// From now on over such a wire, whatever was before.
  void set_transport(const Transport& transport, Time now);

  /// The odometry makes a step, in the base's frame, that the base does not: at once, or in equal parts [s] long.
  void jump(const Pose2& base_from_base, double over);

  /// When it is due. `step`: counts steps of 10 ms.
  void publish_odometry(Time now, std::size_t step, const Body& body);
  /// The scanners of which a sweep is due. `step`: counts steps of 10 ms.
  void publish_scans(Time now, std::size_t step, const Pose2& world_from_base, std::span<const Posture> people);
  /// @param slot  counts steps of 10 ms: the sonars fire in groups of three, each every 0.4 s
  void publish_sonar(Time now, std::uint64_t slot, const Pose2& world_from_base, std::span<const Posture> people);
  /// Each of the ring every 0.2 s, one or two a step of 10 ms.
  void publish_infrared(Time now, std::uint64_t slot, const Pose2& world_from_base, std::span<const Posture> people);
  void publish_battery(Time now, const Battery& battery);
  void publish_tactile(Time now, const std::vector<std::uint8_t>& segments);

  /// Beams of the last sweep of all scanners that met a person.
  [[nodiscard]] int met(std::size_t person) const;
  [[nodiscard]] double blocked_share() const;  ///< beams of the last sweep that met people
  /// [rad] that the lies of all scanners leave out of their last sweeps because something is near there.
  [[nodiscard]] double left_out() const;
  /// True when a ray of some scanner, within its field and its range, reaches a person past walls and other people.
  [[nodiscard]] bool sees(const Pose2& world_from_base, std::size_t person, std::span<const Posture> people) const;

 private:
  struct Scanner {
    Sensor sensor;
    std::string frame;
    ScannerKind kind;
    LaserScanner laser;
    transport::Publisher<sensor_msgs::LaserScan> scans;
    std::optional<sensor_msgs::LaserScan> last;
    std::vector<int> met;  ///< [people] beams of the last sweep
    int blocked = 0;       ///< beams of the last sweep that met people
    ScannerLies lies;
    double late = 0.0;      ///< [s], see Hardware
    std::size_t plane = 0;  ///< index in planes_
  };
  struct Fault {
    FaultKind kind;
    Time until;
    double delay;
  };
  template <class T>
  void emit(Sensor sensor, const transport::Publisher<T>& publisher, T message, std::optional<T>& last, Time now);
  [[nodiscard]] const Fault* fault_of(Sensor sensor, Time now) const;
  /// Over the sensor's wire, if it has one. @param later  [s] it is sent, by its fault
  template <class T>
  void send(Sensor sensor, const transport::Publisher<T>& publisher, T message, Time now, double later = 0.0);
  void publish_ping(Time now, const Ping& ping);
  /// Whether it reaches a disc of the slice past those of others.
  [[nodiscard]] bool shows(const Scanner& scanner, const Pose2& world_from_scanner, std::size_t disc,
                           const Slice& slice) const;
  void publish_scan(Time now, Scanner& scanner, const Pose2& pose, std::span<const Posture> people);
  /// The plane of scanners that are mounted so high.
  [[nodiscard]] std::size_t plane_at(double height);

  transport::Bus& bus_;
  struct Plane {
    double height;  ///< [m] above the floor
    std::unique_ptr<RayCaster> walls;
  };
  std::vector<Plane> planes_;  ///< in which scanners look
  std::unique_ptr<RayCaster> sonar_walls_;
  std::unique_ptr<RayCaster> infrared_walls_;
  std::vector<Scanner> scanners_;
  int beams_ = 0;  ///< of all scanners
  SonarRing ring_;
  InfraredRing infrared_;
  Rng fault_rng_;
  std::array<std::optional<Fault>, kSensors> faults_;
  struct Line {
    Wire wire;
    Time until;
  };
  Rng wire_rng_;
  std::array<std::optional<Line>, kSensors> lines_;  ///< of those whose messages do not come at once
  Slice slice_;                                      ///< of the people, for one sensor after the other
  bool skips_ = false;
  Time last_odometry_{};
  Pose2 last_pose_{};
  bool has_odometry_ = false;
  double odometry_rate_;          ///< [Hz]
  bool is_odometry_news_ = true;  ///< it says something else than before
  Pose2 jump_part_;               ///< base_from_base that the next readings are off
  int jump_parts_ = 0;            ///< so many readings
  OdometryScale scale_;
  Pose2 odom_from_body_odom_;  ///< what jumps have made of the wheels' odometry
  bool has_tactile_;
  std::uint32_t tactile_scan_ = 0;

  transport::Publisher<sensor_msgs::Range> pings_;
  transport::Publisher<sensor_msgs::Range> infrared_readings_;
  transport::Publisher<nav_msgs::Odometry> odometry_;
  transport::Publisher<sensor_msgs::BatteryState> battery_;
  transport::Publisher<docent_msgs::Tactile> tactile_;
  std::vector<std::optional<sensor_msgs::Range>> last_pings_;
  std::vector<std::optional<sensor_msgs::Range>> last_infrared_;
  std::optional<nav_msgs::Odometry> last_odom_;
  std::optional<docent_msgs::Tactile> last_tactile_;
};

}  // namespace docent::simulator
