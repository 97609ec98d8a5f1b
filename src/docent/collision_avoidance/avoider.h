#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/collision_avoidance/base_motion.h"
#include "docent/collision_avoidance/dynamic_window.h"
#include "docent/collision_avoidance/freshness.h"
#include "docent/collision_avoidance/obstacle_memory.h"
#include "docent/collision_avoidance/speed_near_people.h"

namespace docent {

struct AvoiderParams {
  DynamicWindowParams window;
  PeopleCautionParams people;
  double lookahead = 1.2;              ///< [m] the path is followed by steering for a point so far along it
  double arrival_deceleration = 0.35;  ///< [m/s2]
  double target_timeout = 1.5;         ///< [s]
  double virtual_timeout = 1.5;        ///< [s]
  bool needs_sonar = true;             ///< stands when the sonars are silent
  bool blind_to_people = false;        ///< crippled, for evaluation: sees virtual measurements and touch only
  template <class V>
  void visit(V& v) {
    v("window", window);
    v("lookahead", lookahead);
    v("people", people);
    v("arrival_deceleration", arrival_deceleration);
    v("target_timeout", target_timeout);
    v("virtual_timeout", virtual_timeout);
    v("needs_sonar", needs_sonar);
    v("blind_to_people", blind_to_people);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where to go, odometry's frame.
struct AvoiderTarget {
  enum class Mode { stop, drive, turn };
  Mode mode = Mode::stop;
  std::vector<Point2> via;  ///< [m], nearest first
  bool is_final = false;    ///< the last via-point is the goal
  Angle heading{};          ///< for turn
  double position_tolerance = 0.25;
  double heading_tolerance = 0.1;
};

/// Virtual measurements, base frame at their stamp.
struct VirtualSweep {
  Time stamp;
  double first_bearing = 0.0;
  double bearing_step = 0.0;
  double max_range = 0.0;
  std::vector<float> ranges;
};

struct AvoiderDecision {
  enum class State { driving, turning, stopped, blocked };
  Velocity command;
  State state = State::stopped;
  std::string reason;      ///< why it stands or is slow; empty when nothing hinders
  double speed_cap = 0.0;  ///< [m/s]
  bool path_blocked = false;
  bool unmapped_obstacle = false;
  double nearest_real = 0.0;     ///< [m] from the outline
  double nearest_virtual = 0.0;  ///< [m]
  std::vector<EvaluatedVelocity> window;
};

/// Collision avoidance of the tour guide, µDWA [BurgardEtAl1999 4.1; ThrunEtAl2000 5.1]: keeps the obstacle field,
/// knows how old everything is, steers along via-points with the dynamic window, and brakes on any scan that says so.
/// Safe without planner, localization or radio (architecture 8).
///
/// Sensor inputs take the local time of receipt and the stamp of their message.
class Avoider {
 public:
  Avoider(const BaseLimits& limits, const AvoiderParams& params, std::size_t laser_count);

  void add_odometry(Time now, Time stamp, const BaseState& state);
  void add_sweep(Time now, std::size_t sensor, const SensorSweep& sweep);
  void add_sonar(Time now, std::size_t index, const SonarReading& reading);
  void add_infrared(Time now, std::size_t index, const SonarReading& reading);
  /// What a camera saw on the floor, base frame at `stamp`.
  void add_lines(Time now, Time stamp, const std::string& source, double lifetime, std::span<const Segment> in_base);
  /// @param bearings  [rad] of the pressed segments
  void add_tactile(Time now, Time stamp, std::span<const double> bearings);
  void add_virtual(Time now, const VirtualSweep& sweep);
  /// Endpoints that localization found unmapped, base frame at `stamp`.
  void add_person_beams(Time now, Time stamp, std::span<const Point2> in_base, bool localized);
  void set_target(Time now, Time stamp, AvoiderTarget target);
  void set_max_speed(double max_speed) { max_speed_ = max_speed; }

  /// One selection, every `window.cycle`. The command counts as given at `now`.
  [[nodiscard]] AvoiderDecision decide(Time now);
  /// To be called on every scan: full braking when the present command is no longer safe against what was just seen.
  [[nodiscard]] std::optional<AvoiderDecision> reflex(Time now);

  [[nodiscard]] const ObstacleMemory& memory() const { return memory_; }
  [[nodiscard]] const Velocity& command() const { return command_; }
  /// What is stale or broken, "" when all is well.
  [[nodiscard]] std::string fault(Time now) const;

 private:
  struct Carrot {
    Point2 in_base;
    double remaining = 0.0;  ///< [m] along the path to its end
  };
  [[nodiscard]] BaseState state_when_effective(Time now) const;
  [[nodiscard]] std::vector<Obstacle> obstacles_from(const Pose2& odom_from_base, Time when) const;
  [[nodiscard]] Carrot carrot(const Pose2& odom_from_base, std::span<const Obstacle> obstacles) const;
  [[nodiscard]] double steer_around(Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles);
  /// Caps the speed and says why.
  void cap_speed(double cap, const char* why, AvoiderDecision& decision) const;
  void cap_by_knowledge(Time now, AvoiderDecision& decision) const;
  void cap_by_surroundings(std::span<const Obstacle> obstacles, double bearing, AvoiderDecision& decision) const;
  void judge_blocking(Time now, Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                      AvoiderDecision& decision) const;
  AvoiderDecision finish(Time now, AvoiderDecision decision);
  AvoiderDecision stand(Time now, AvoiderDecision decision, std::string reason);

  BaseLimits limits_;
  AvoiderParams params_;
  std::size_t laser_count_;
  DynamicWindow window_;
  ObstacleMemory memory_;
  BaseHistory odometry_;
  CommandHistory commands_;
  Velocity command_;
  double max_speed_ = 0.7;

  std::vector<Freshness> sweep_freshness_;
  Freshness odometry_freshness_;
  Freshness sonar_freshness_;  ///< of any
  std::vector<Freshness> each_sonar_freshness_;
  Freshness tactile_freshness_;   ///< a robot without the ring never sends; one that has sent must go on
  Freshness infrared_freshness_;  ///< likewise, of any
  std::map<std::string, Freshness> line_freshness_;  ///< likewise, of each camera
  Freshness virtual_freshness_;
  Freshness target_freshness_;
  std::optional<AvoiderTarget> target_;
  std::optional<VirtualSweep> virtual_;
  std::optional<Pose2> odom_from_virtual_;
  std::vector<Point2> unmapped_in_odom_;
  std::optional<Time> unmapped_time_;
  bool beams_localized_ = false;
  std::optional<Time> touched_;
  std::optional<Angle> steered_in_odom_;
  double turning_side_ = 0.0;  ///< +1 left, -1 right, while something behind is turned to; else 0
};

/// Blows the horn at people in the way [BurgardEtAl1999 5.3]: after 1.5 s behind an unmapped obstacle, every 6 s at
/// most.
class Horn {
 public:
  [[nodiscard]] bool is_due(Time now, bool blocked_by_unmapped);

 private:
  std::optional<Time> blocked_since_;
  std::optional<Time> last_clear_;
  std::optional<Time> blown_;
};

}  // namespace docent
