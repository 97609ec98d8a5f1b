#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/task_control/mission/battery_watch.h"
#include "docent/task_control/mission/planner.h"
#include "docent/task_control/tour_scheduler/task_order.h"
#include "docent/task_control/tour_scheduler/tour_scheduler.h"
#include "docent/task_control/travel_times/visit_watch.h"

namespace docent::task_control {

/// Section `mission` of robot.yaml.
struct MissionParams {
  SchedulerParams schedule;
  double lost_after_s = 3.0;       ///< [s] >= 0 without localization before a tour is suspended
  double localized_after_s = 1.0;  ///< [s] >= 0 with localization before it is resumed
  double at_home_m = 0.7;          ///< [m] > 0: so near, the robot is at home
  double home_retry_s = 30.0;      ///< [s] >= 0 after a failed way home
  double at_charger_m = 0.3;       ///< [m] > 0: so near, it is at a charger whose battery does not say that it charges
  double contact_s = 10.0;         ///< [s] >= 0 until a battery at its charger says so; then the robot tries again
  double battery_low = 0.15;       ///< 0..1: still left on arrival at its charger; what has begun may use half of it
  /// 0..1: with less it charges between two tours, before it must, though somebody waits. Below what it charges to.
  double battery_soon = 0.25;
  double battery_full = 0.95;  ///< 0..1, > battery_low: charged; the last part takes real batteries long
  /// 0..1: what makes the way to the charger worth while. An idle robot goes there when so much is missing; people
  /// who wait are served again when there is so much more than battery_low.
  double battery_gain = 0.25;
  bool mingles = true;           ///< attracts people while it rests at home and nobody wants anything
  double mingle_pause_s = 30.0;  ///< [s] >= 0 between two phases: who listens may choose
  double drain_per_s = 1.4e-4;   ///< [1/s] > 0 share of a full battery: two hours of driving; more is measured
  double charge_per_s = 2.2e-4;  ///< [1/s] > 0 likewise: 75 minutes; measured while it charges
  template <class V>
  void visit(V& v) {
    schedule.visit(v);
    v("lost_after_s", lost_after_s);
    v("localized_after_s", localized_after_s);
    v("at_home_m", at_home_m);
    v("home_retry_s", home_retry_s);
    v("at_charger_m", at_charger_m);
    v("contact_s", contact_s);
    v("battery_low", battery_low);
    v("battery_soon", battery_soon);
    v("battery_full", battery_full);
    v("battery_gain", battery_gain);
    v("mingles", mingles);
    v("mingle_pause_s", mingle_pause_s);
    v("drain_per_s", drain_per_s);
    v("charge_per_s", charge_per_s);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// All that must survive a restart of the mission.
struct MissionMemory {
  SchedulerState schedule;
  std::string deployment;       ///< begins every task id: no task of another life of the database is taken for ours
  std::uint64_t next_task = 1;  ///< number of the next task
  TaskOrder task;               ///< the present one
  bool must_charge = false;     ///< the battery is too low to go on
  std::string planner{};        ///< what the planner must remember
  /// Of travel times: all when it begins, then what was learned since it was stored.
  std::vector<LessonRow> lessons{};
};

/// What the robot is about.
struct MissionSummary {
  MissionPhase phase = MissionPhase::waking;
  std::string tour_id;
  std::string exhibit_id;
  bool is_blocked = false;     ///< people are in the way
  bool is_charging = false;    ///< or on its way to the charger
  bool needs_charge = false;   ///< it must, before it goes on
  bool says_farewell = false;  ///< at the end of a tour
  int charging_min = 0;        ///< [min] until it is charged well enough, in steps of five
  Counters counters;
  std::vector<std::string> agenda;
};

/// What the robot is about, from waking up to going home: it keeps the requests, knows how the robot is (its place, its
/// charge, its task), and gives tasks to the executive. Which task comes next is the planner's choice: the museum's
/// `plans` or its `golog` program. Deterministic; knows nothing of messages and files.
///
/// Wherever it is, the robot keeps enough charge to reach its charger with `battery_low` left, or half of that once it
/// has begun a visit or a tour; `situation()` tells the planner when it must go.
class Mission {
 public:
  Mission(const MissionParams& params, Programme programme, TravelDistance travel, MissionMemory memory,
          std::unique_ptr<Planner> planner, Time now);

  void submit(VisitorRequest request, Time now);
  /// How a task goes; nullopt: as nobody here understands. Reports of other tasks than the present are ignored.
  /// @param took_long  the visitor asked for more
  void report(const std::string& task_id, std::optional<TaskStatus> state, const Reason& reason, Time now,
              bool took_long = false);
  /// @param position  best guess [m], map
  void localization(bool is_localized, Point2 position, Time now);
  void limits(bool is_open, std::optional<OperatingMode> mode);
  /// @param hour  of the day, 0..23: travel times depend on it
  void time_of_day(int hour) { scheduler_.times().set_hour(hour); }
  /// @param charge  0..1. @param is_charging  nullopt: the battery does not say
  void battery(double charge, std::optional<bool> is_charging, Time now);
  [[nodiscard]] bool is_battery_silent(Time now) const { return battery_.is_silent(now); }
  /// @param has_company  people are near
  void company(bool has_company) { has_company_ = has_company; }
  /// Once or twice a second.
  void tick(Time now);

  [[nodiscard]] const TaskOrder& task() const { return task_; }
  [[nodiscard]] MissionSummary summary(Time now);
  [[nodiscard]] MissionMemory memory() const;
  [[nodiscard]] TourScheduler& scheduler() { return scheduler_; }
  /// What is wrong with the planner; empty: nothing.
  [[nodiscard]] std::string planner_fault() const { return planner_->fault(); }
  /// What `memory` held is stored.
  void mark_stored();
  [[nodiscard]] std::vector<Happening> take_happenings() { return scheduler_.take_happenings(); }

  // For planners: what they see, and the primitive actions that they choose from.
  [[nodiscard]] Situation situation(Time now) const;
  /// Begins the scheduler's next visit from here; false: nothing to do now, or what comes next would take more charge
  /// than there is. @pre no visit is under way.
  [[nodiscard]] bool begin_visit(Time now);
  /// Gives the visit under way to the executive, once more after it was suspended.
  void order_visit(Time now);
  /// Says farewell where a tour has ended. @pre situation().has_farewell
  void say_farewell();
  /// Ends the visit and the tour under way for want of charge, with a word to the visitors; their requests wait.
  void break_off_to_charge(Time now);
  /// Drives to its charger, or stays there.
  void go_charging(Time now);
  /// The order for that. Where a visit or a tour was broken off for it, it names them, so that the robot says so.
  [[nodiscard]] TaskOrder order_to_charge();
  /// Drives home, or stays there.
  void go_home(Time now);
  /// Attracts people for a minute, where it stands. @pre situation().may_mingle
  void mingle(Time now);
  void relocalize(Time now);
  /// It knows its place again.
  void end_relocalizing(Time now);
  /// Any action that the executive knows; whatever was under way is over.
  void order_action(TaskOrder order);
  /// As it is now, for the order of an action: the visit's language, else the museum's own.
  [[nodiscard]] std::string language() const;
  [[nodiscard]] Point2 position() const;
  /// What comes next takes more charge than there is.
  void need_charge(const std::string& why, Time now);

 private:
  void decide(Time now);
  /// Times the drive and the visit of the present task.
  void learn(TaskStatus status, Time now);
  void start_task(Activity activity, TaskOrder order);
  /// The way home or to the charger is over.
  void note_rest(TaskKind kind, bool is_done, const Reason& reason);
  [[nodiscard]] bool may_interrupt() const;
  [[nodiscard]] std::string visited_exhibit() const;  ///< empty: no visit is under way
  [[nodiscard]] MissionPhase phase_of_action() const;
  [[nodiscard]] bool is_lost(Time now) const;
  [[nodiscard]] bool charges() const { return must_charge_ || tops_up_; }
  [[nodiscard]] Pose2 resting_place() const;
  /// Charge left [share] after the way to the charger and what is kept in reserve; +infinity: the battery never spoke.
  [[nodiscard]] double spare(Time now) const;
  /// How long it may be busy before it must charge [s].
  [[nodiscard]] double budget_s(Time now) const;
  [[nodiscard]] double enough_to_serve() const;
  void watch_battery(Time now);
  [[nodiscard]] const std::vector<std::string>& agenda(Time now);
  [[nodiscard]] bool is_at_charger() const;
  [[nodiscard]] bool has_contact(Time now) const;

  MissionParams params_;
  TourScheduler scheduler_;
  std::unique_ptr<Planner> planner_;
  VisitWatch watch_;
  std::string deployment_;
  std::uint64_t next_task_;
  TaskOrder task_;
  Activity activity_ = Activity::none;
  std::optional<TaskStatus> task_state_;
  Reason task_reason_;

  bool is_localized_ = false;
  bool was_ever_localized_ = false;
  Time localization_changed_;
  Time lost_since_;
  std::optional<Point2> position_;
  Conditions conditions_;
  BatteryWatch battery_;
  bool must_charge_;            ///< too little is left to go on
  bool tops_up_ = false;        ///< charges, or goes to its charger, whenever nobody wants anything
  std::string broken_exhibit_;  ///< what was broken off for the charge that comes
  std::string broken_tour_;
  bool is_resting_ = false;  ///< arrived at home, nothing has happened since
  bool has_company_ = false;
  Time mingle_not_before_{};
  Time home_not_before_{};           ///< nor to the charger
  std::vector<std::string> agenda_;  ///< it is costly, so it is made anew only when board or task have changed
  std::uint64_t agenda_revision_ = 0;
  std::string agenda_task_ = "none yet";
};

}  // namespace docent::task_control
