#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/body/speed_near_people.h"
#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"
#include "docent/collision_avoidance/obstacle_field/near_points.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"
#include "docent/collision_avoidance/obstacle_field/seen_places.h"
#include "docent/collision_avoidance/watches/complaint.h"
#include "docent/collision_avoidance/watches/freshness.h"
#include "docent/collision_avoidance/watches/local_time.h"
#include "docent/collision_avoidance/watches/odometry_watch.h"
#include "docent/collision_avoidance/watches/position_doubt.h"
#include "docent/collision_avoidance/watches/ring_watch.h"
#include "docent/collision_avoidance/watches/tactile_watch.h"
#include "docent/motion_models/unbroken_odometry.h"

namespace docent {

/// Section `avoid`: collision avoidance, which keeps clear of everything whatever the others want.
struct AvoiderParams {
  DynamicWindowParams window;
  PeopleCautionParams people;
  /// cautious_window: the dynamic window, slower near people, who are foreseen for a second; dynamic_window: the plain
  /// one, for comparison, with people as things that stand where they are now.
  std::string method = "cautious_window";
  double lookahead = 1.2;             ///< [m] the path is followed by steering for a point so far along it, at least,
  double lookahead_time = 1.5;        ///< [s] and as far as the robot drives in this time
  double arrival_deceleration = 0.6;  ///< [m/s2] with which it comes to a stop at its goal
  double target_timeout = 1.5;        ///< [s] without a new target, then it stands
  double virtual_timeout = 1.5;       ///< [s] without new virtual measurements, then it stands
  double seen_for = 3.0;              ///< [s] a place that a laser saw to be free counts as free when none looks there
  bool needs_sonar = true;            ///< stands when the sonars are silent
  bool has_infrared = false;          ///< the body has these rings: stands when they are silent, from the start on
  bool has_tactile = false;
  bool blind_to_people = false;  ///< crippled, for evaluation: sees virtual measurements and touch only
  bool watches = true;           ///< false: likewise: takes every sensor and belief for well
  template <class V>
  void visit(V& v) {
    v("window", window);
    v("lookahead", lookahead);
    v("lookahead_time", lookahead_time);
    v("people", people);
    v("method", method);
    v("arrival_deceleration", arrival_deceleration);
    v("target_timeout", target_timeout);
    v("virtual_timeout", virtual_timeout);
    v("seen_for", seen_for);
    v("needs_sonar", needs_sonar);
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

/// Virtual measurements, base frame at their stamp: a turn of those of hazards, from `first_bearing` on, then where
/// there is more another turn, of those of the area's border.
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
  bool low_obstacle = false;     ///< what blocks the path, or has touched it here, is a thing below the lasers
  double nearest_real = 0.0;     ///< [m] from the outline
  double nearest_virtual = 0.0;  ///< [m] likewise of hazards; from the centre of the area's border
  std::vector<EvaluatedVelocity> window;
};

/// Collision avoidance of the tour guide, µDWA [Rhino1999] 4.1, [Minerva2000] 5.1: keeps the obstacle field,
/// knows how old everything is, steers along via-points with the dynamic window, and brakes on any scan that says so.
/// Safe without planner, localization or radio (architecture 8).
///
/// Sensor inputs take the local time of receipt and the stamp of their message, by whatever clock; all that is kept and
/// compared is in local time.
class Avoider {
 public:
  /// @param lasers  their names for a person: "front laser". Sweeps are numbered so
  Avoider(const BaseLimits& limits, const AvoiderParams& params, std::vector<std::string> lasers);

  /// @param state  as the base says it: jumps are taken out here, and targets are carried over them
  void add_odometry(Time now, Time stamp, const BaseState& state);
  void add_sweep(Time now, std::size_t sensor, SensorSweep sweep);
  void add_sonar(Time now, std::size_t index, SonarReading reading);
  void add_infrared(Time now, std::size_t index, SonarReading reading);
  /// What a camera saw on the floor, base frame at `stamp`.
  void add_lines(Time now, Time stamp, const std::string& source, double lifetime, std::span<const Segment> in_base);
  /// @param segments  evenly round the body, the first at the front: 1 pressed, TactileWatch::kNoReading
  /// @param scan  count of the ring's own scans; 0: it keeps none
  void add_tactile(Time now, Time stamp, std::span<const std::uint8_t> segments, std::uint32_t scan = 0);
  void add_virtual(Time now, VirtualSweep sweep);
  /// Endpoints that localization found unmapped, base frame at `stamp`.
  void add_person_beams(Time now, Time stamp, std::span<const Point2> in_base, bool localized);
  /// What localization believes: it slows the robot where that is little (safety rule 4).
  void add_belief(const BeliefOutline& belief) { doubt_.believe(belief); }
  void set_target(Time now, Time stamp, AvoiderTarget target);
  void set_max_speed(double max_speed) { max_speed_ = max_speed; }

  /// True when another laser's sweep is due by its period within `soon` [s]: a choice had better wait for it.
  [[nodiscard]] bool awaits_sweep(Time now, double soon) const;

  /// One selection, with people where they are now; what was chosen is checked as by `reflex` before it is given. To be
  /// called when the lasers have seen anew, and every `window.cycle` when they have not. The command counts as given at
  /// `now`.
  [[nodiscard]] AvoiderDecision decide(Time now);
  /// To be called on every scan that is not decided upon, and when hazards are measured: full braking when the present
  /// command is no longer safe against what was just seen and where it will be, and the same arc more slowly where
  /// people may come nearer than is forgivable.
  [[nodiscard]] std::optional<AvoiderDecision> reflex(Time now);

  [[nodiscard]] const ObstacleMemory& memory() const { return memory_; }
  [[nodiscard]] const Velocity& command() const { return command_; }
  /// What is stale or broken, the worst of it; nullopt when all is well.
  [[nodiscard]] std::optional<Complaint> complaint_of_inputs(Time now) const;
  /// The same, or what is doubtful of the position.
  [[nodiscard]] std::optional<Complaint> complaint(Time now) const;
  /// Why it must stand, "" when it need not.
  [[nodiscard]] std::string fault(Time now) const;

 private:
  struct Carrot {
    Point2 in_base;
    double remaining = 0.0;  ///< [m] along the path to its end
  };
  [[nodiscard]] bool is_touched(Time now, double within) const;
  [[nodiscard]] std::optional<Complaint> complaint_of_laser(Time now, std::size_t index) const;
  [[nodiscard]] BaseState state_when_effective(Time now) const;
  /// How far [m] what may matter before the robot can stand lies at most.
  [[nodiscard]] double reach() const;
  /// [m] from the robot: who stands farther away cannot step into its way in time.
  [[nodiscard]] double steps_in() const;
  static void tell_nearest(std::span<const Obstacle> obstacles, const BaseLimits& limits, AvoiderDecision& decision);
  [[nodiscard]] std::vector<Obstacle> obstacles_from(const Pose2& odom_from_base, Time when) const;
  /// @param speed  [m/s] of the robot now
  [[nodiscard]] Carrot carrot(const Pose2& odom_from_base, double speed, std::span<const Obstacle> obstacles) const;
  /// True when the way does not even begin because of a hazard's margin, or of what is sensed beside the robot: it must
  /// slide off. What stands ahead is another matter: that may go, and it waits.
  [[nodiscard]] bool must_slide_off(double bearing, std::span<const Obstacle> obstacles) const;
  [[nodiscard]] double steer_around(Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles);
  /// What to steer for, by the method; caps the speed.
  [[nodiscard]] Steering steering_for(const Carrot& ahead, const Pose2& odom_from_base,
                                      std::span<const Obstacle> obstacles, AvoiderDecision& decision);
  /// Caps the speed and says why.
  void cap_speed(double cap, std::string_view why, AvoiderDecision& decision) const;
  void cap_by_knowledge(Time now, AvoiderDecision& decision) const;
  void cap_by_surroundings(std::span<const Obstacle> obstacles, AvoiderDecision& decision) const;
  /// The present command, slowed for whoever may come nearer within a second; nullopt when it may stay.
  [[nodiscard]] std::optional<Velocity> slowed_for_people(std::span<const Obstacle> obstacles) const;
  void judge_blocking(Time now, Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                      AvoiderDecision& decision) const;
  AvoiderDecision finish(Time now, AvoiderDecision decision);
  AvoiderDecision stand(Time now, AvoiderDecision decision, std::string reason);

  BaseLimits limits_;
  AvoiderParams params_;
  std::vector<std::string> lasers_;
  DynamicWindow window_;
  ObstacleMemory memory_;
  SeenPlaces seen_;
  BaseHistory odometry_;
  CommandHistory commands_;
  Velocity command_;
  double max_speed_ = 0.7;

  LocalTime local_time_;
  std::vector<Freshness> sweep_freshness_;
  UnbrokenOdometry unbroken_;
  OdometryWatch odometry_watch_;
  RingWatch sonar_watch_{"sonar reading", "sonars"};
  RingWatch infrared_watch_{"infrared reading", "infrared sensors"};
  TactileWatch tactile_watch_;
  std::map<std::string, Freshness> line_freshness_;  ///< of each camera; one that has sent must go on
  PositionDoubt doubt_;
  Freshness virtual_freshness_;
  Freshness target_freshness_;
  std::optional<AvoiderTarget> target_;
  std::optional<VirtualSweep> virtual_;
  std::optional<Pose2> odom_from_virtual_;
  struct Unmapped {
    Point2 in_odom;
    Time heard;
  };
  std::vector<Unmapped> unmapped_;
  std::optional<NearPoints> near_unmapped_;  ///< of these
  Time unmapped_time_{};                     ///< when the newest were taken
  bool beams_localized_ = false;
  std::optional<Time> touched_;
  Time touched_since_{};
  Angle touched_from_{};  ///< odom
  std::optional<Angle> steered_in_odom_;
  double turning_side_ = 0.0;  ///< +1 left, -1 right, while something behind is turned to; else 0
};

}  // namespace docent
