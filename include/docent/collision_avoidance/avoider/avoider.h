#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "docent/collision_avoidance/avoider/avoider_params.h"
#include "docent/collision_avoidance/avoider/carried_off.h"
#include "docent/collision_avoidance/avoider/carrot.h"
#include "docent/collision_avoidance/avoider/hand_steering.h"
#include "docent/collision_avoidance/avoider/input_watches.h"
#include "docent/collision_avoidance/avoider/people_caution.h"
#include "docent/collision_avoidance/avoider/surroundings.h"
#include "docent/collision_avoidance/body/base_motion.h"
#include "docent/collision_avoidance/clocks/driver_stamps.h"
#include "docent/collision_avoidance/clocks/local_time.h"
#include "docent/collision_avoidance/dynamic_window/dynamic_window.h"
#include "docent/collision_avoidance/local_planner/local_planner.h"
#include "docent/collision_avoidance/local_planner/speed_cap.h"
#include "docent/collision_avoidance/watches/complaint.h"
#include "docent/collision_avoidance/watches/contact_watch.h"
#include "docent/collision_avoidance/watches/freshness.h"
#include "docent/collision_avoidance/watches/position_doubt.h"
#include "docent/motion_models/unbroken_odometry.h"

namespace docent::collision_avoidance {

/// Where to go, odometry's frame.
struct AvoiderTarget {
  /// Stand; drive along `via`; turn on the spot to `heading`.
  enum class Mode { stop, drive, turn };
  Mode mode = Mode::stop;            ///< what to do
  std::vector<Point2> via;           ///< [m], nearest first
  bool is_final = false;             ///< the last via-point is the goal
  Angle heading{};                   ///< for turn
  double position_tolerance = 0.25;  ///< [m] so near is there
  double heading_tolerance = 0.1;    ///< [rad] likewise
};

/// What the robot is to do until the next decision, and why.
struct AvoiderDecision {
  /// What it does; blocked: it would, and cannot.
  enum class State { driving, turning, stopped, blocked };
  Velocity command;              ///< for the base
  State state = State::stopped;  ///< what it does
  std::string reason;  ///< why it stands or is slow: a word of ReasonWord, or in English what is broken; empty: nothing
  double speed_cap = 0.0;                 ///< [m/s]
  bool path_blocked = false;              ///< no way leads on along the via-points
  bool unmapped_obstacle = false;         ///< what blocks is not on the map
  bool low_obstacle = false;              ///< what blocks the path, or has touched it here, is a thing below the lasers
  double nearest_real = 0.0;              ///< [m] from the outline
  double nearest_virtual = 0.0;           ///< [m] likewise of hazards; from the centre of the area's border
  std::vector<EvaluatedVelocity> window;  ///< all that was weighed, for pictures
};

/// Collision avoidance of the tour guide, µDWA [Rhino1999] 4.1, [Minerva2000] 5.1: keeps the obstacle field,
/// knows how old everything is, drives along via-points as a local planner says, by default with the dynamic window,
/// and brakes on any scan that says so. Safe without planner, localization or radio (architecture 8).
///
/// Its parts keep what they need to know by themselves: the surroundings what must not be touched, the watches what is
/// silent or broken, the caution what holds near people, the local planner how to follow a path. This class takes their
/// inputs into local time and odometry's frame, decides, and checks whatever the planner wants.
///
/// Sensor inputs take the local time of receipt and the stamp of their message, by whatever clock; all that is kept and
/// compared is in local time.
class Avoider {
 public:
  /// @param lasers  their names for a person: "front laser". Sweeps are numbered so
  /// @param planner  chooses velocities along paths; null: the one that `params.method` names. Turns on the spot and a
  /// hand's wishes are driven with the dynamic window, whatever the planner
  Avoider(const BaseLimits& limits, const AvoiderParams& params, std::vector<std::string> lasers,
          std::unique_ptr<LocalPlanner> planner = nullptr);

  /// @param state  as the base says it: jumps are taken out here, and targets are carried over them
  void add_odometry(Time now, Time stamp, const BaseState& state);
  void add_sweep(Time now, std::size_t sensor, SensorSweep sweep);       ///< a scan of laser `sensor`
  void add_sonar(Time now, std::size_t index, SonarReading reading);     ///< a reading of sonar `index`
  void add_infrared(Time now, std::size_t index, SonarReading reading);  ///< a reading of infrared sensor `index`
  /// What a camera saw on the floor, base frame at `stamp`.
  void add_lines(Time now, Time stamp, const std::string& source, double lifetime, std::span<const Segment> in_base);
  /// @param segments  evenly round the body, the first at the front: 1 pressed, TactileWatch::kNoReading
  /// @param scan  count of the ring's own scans; 0: it keeps none
  void add_tactile(Time now, Time stamp, std::span<const std::uint8_t> segments, std::uint32_t scan = 0);
  void add_virtual(Time now, VirtualSweep sweep);  ///< hazards, measured from the belief
  /// Endpoints that localization found unmapped, base frame at `stamp`.
  void add_person_beams(Time now, Time stamp, std::span<const Point2> in_base, bool localized);
  /// What localization believes: it slows the robot where that is little (safety rule 4).
  void add_belief(const BeliefOutline& belief) {
    doubt_.believe(belief);
    says_here_ = belief.localized;
  }
  /// The map that lasers are compared with, where the robot believes to be; before the first sweep.
  void know_map(const std::shared_ptr<const OccupancyGrid>& map) { inputs_.know_map(limits_, map); }
  /// The best hypothesis of a belief. @param raw_from_robot  odometry at its stamp, as the base says it
  /// @param mass  of the belief there, 0..1
  void add_place(Time now, Time stamp, const Pose2& map_from_robot, const Pose2& raw_from_robot, double mass);
  void set_target(Time now, Time stamp, AvoiderTarget target);  ///< where to go from now on
  /// An operator steers: as long as their word is fresh, no target counts. What must not be touched stays so.
  void steer_by_hand(Time now, const HandSteering& wish) { hand_ = {wish, now}; }
  /// A robot that docks says which velocity it wants: as long as its word is fresh, no target counts. It is checked as
  /// a local planner's; slow enough, the robot may come nearer to things, but touches none.
  void dock_with(Time now, const Velocity& wish) { dock_.want(now, wish); }
  /// The stop button.
  void stop_by_hand(bool is_stopped) { is_stopped_ = is_stopped; }
  void set_max_speed(double max_speed) { max_speed_ = max_speed; }  ///< [m/s] no faster than that

  /// True when another laser's sweep is due by its period within `soon` [s]: a choice had better wait for it.
  [[nodiscard]] bool awaits_sweep(Time now, double soon) const { return inputs_.await_sweep(now, soon); }

  /// One selection, with people where they are now; what was chosen is checked as by `reflex` before it is given. To be
  /// called when the lasers have seen anew, and every `window.cycle` when they have not. The command counts as given at
  /// `now`.
  [[nodiscard]] AvoiderDecision decide(Time now);
  /// To be called on every scan that is not decided upon, and when hazards are measured: full braking when the present
  /// command is no longer safe against what was just seen and where it will be, and the same arc more slowly where
  /// people may come nearer than is forgivable.
  [[nodiscard]] std::optional<AvoiderDecision> reflex(Time now);

  /// How often, since it began, the scans could not follow one another: somebody has carried the robot.
  [[nodiscard]] std::uint32_t times_carried_off() const { return carried_off_.times(); }
  /// It does not know yet where it was put.
  [[nodiscard]] bool is_carried_off() const { return carried_off_.is_unsettled(); }
  /// What was seen, odometry's frame.
  [[nodiscard]] const ObstacleMemory& memory() const { return surroundings_.memory(); }
  [[nodiscard]] const Velocity& command() const { return command_; }  ///< the last one given
  /// What is stale or broken, the worst of it; nullopt when all is well.
  [[nodiscard]] std::optional<Complaint> complaint_of_inputs(Time now) const;
  /// The same, or what is doubtful of the position.
  [[nodiscard]] std::optional<Complaint> complaint(Time now) const;
  /// Why it must stand, "" when it need not.
  [[nodiscard]] std::string fault(Time now) const;

 private:
  /// A sweep that comes after a newer one, or twice.
  [[nodiscard]] bool was_overtaken(std::size_t sensor, Time stamp);
  [[nodiscard]] bool is_touched(Time now, double within) const;
  /// Keeps in mind what only touch finds.
  void feel(Time now, TouchedBy who, Angle bearing, const Pose2& odom_from_base);
  [[nodiscard]] BaseState state_when_effective(Time now) const;
  /// [m/s] that the robot may drive at most.
  [[nodiscard]] double top_speed() const { return std::min(max_speed_, limits_.max_speed); }
  void tell_nearest(std::span<const Obstacle> obstacles, AvoiderDecision& decision) const;
  [[nodiscard]] std::vector<Obstacle> obstacles_from(const Pose2& odom_from_base, Time when) const {
    return surroundings_.obstacles(odom_from_base, when, top_speed(), caution_);
  }
  /// Why the robot must stand whatever it is to do; nullopt when it may move.
  [[nodiscard]] std::optional<std::string> reason_to_stand(Time now) const;
  /// To the target's heading; nullopt when the robot has it.
  [[nodiscard]] std::optional<Steering> turn_to_heading(const BaseState& start, AvoiderDecision& decision) const;
  /// Along the via-points, as the local planner wants and the robot may.
  [[nodiscard]] AvoiderDecision follow_path(Time now, const BaseState& start, std::span<const Obstacle> obstacles,
                                            AvoiderDecision decision);
  /// The target's speed at its end, and what is known; nullopt when it is there.
  [[nodiscard]] std::optional<SpeedCap> cap_along_path(Time now, const BaseState& start, double remaining) const;
  /// As the docking robot wants, where that is safe.
  [[nodiscard]] AvoiderDecision follow_dock(Time now, const BaseState& start, std::span<const Obstacle> obstacles,
                                            AvoiderDecision decision);
  /// What the base may do of a plan. @param nearer  [m] than the margins it may come to things
  [[nodiscard]] AvoiderDecision checked(const LocalTask& task, LocalPlan plan, double nearer,
                                        AvoiderDecision decision) const;
  /// The command as near as the base can come to it, and as fast as is allowed; standing where it is no number.
  [[nodiscard]] Velocity within_limits(const Velocity& command, const LocalTask& task) const;
  /// The base can keep to it until the watchdog bites, or the next sweep, and brake then.
  [[nodiscard]] bool may_keep_to(const Velocity& command, const LocalTask& task, double nearer) const;
  /// What the hand says; nullopt: nothing, or nothing new.
  [[nodiscard]] const HandSteering* hand(Time now) const;
  [[nodiscard]] std::optional<Steering> steer_as_hand(Time now, const HandSteering& wish,
                                                      AvoiderDecision& decision) const;
  void cap_by_knowledge(Time now, SpeedCap& cap) const;
  /// @returns whether a thing that only touch finds is near
  bool cap_by_touched_things(Time now, const Pose2& odom_from_base, SpeedCap& cap) const;
  void judge_blocking(Time now, Point2 carrot, const Pose2& odom_from_base, std::span<const Obstacle> obstacles,
                      AvoiderDecision& decision) const;
  AvoiderDecision finish(Time now, AvoiderDecision decision);
  AvoiderDecision stand(Time now, AvoiderDecision decision, std::string reason);

  BaseLimits limits_;
  AvoiderParams params_;
  PeopleCaution caution_;
  std::unique_ptr<LocalPlanner> planner_;
  DynamicWindow window_;  ///< for turns on the spot and by hand
  Surroundings surroundings_;
  InputWatches inputs_;
  CarriedOff carried_off_;
  bool says_here_ = false;  ///< the newest belief
  ContactWatch contact_;
  PositionDoubt doubt_;
  LocalTime local_time_;
  OdometryStamps odometry_stamps_;
  motion_models::UnbrokenOdometry unbroken_;
  struct SweepOrder {
    std::optional<Time> newest;  ///< stamp
    int older = 0;               ///< sweeps in succession that were older
  };
  std::vector<SweepOrder> sweep_order_;  ///< [lasers]
  BaseHistory odometry_;
  CommandHistory commands_;
  Velocity command_;
  double max_speed_;
  Freshness target_freshness_;
  std::optional<AvoiderTarget> target_;
  struct Hand {
    HandSteering wish;
    Time said;
  };
  std::optional<Hand> hand_;
  DockDrive dock_;
  bool is_stopped_ = false;
};

}  // namespace docent::collision_avoidance
