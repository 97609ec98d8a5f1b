#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/task_control/mission/battery_watch.h"
#include "docent/task_control/mission/mission_params.h"
#include "docent/task_control/mission/planner.h"
#include "docent/task_control/mission/staff_call.h"
#include "docent/task_control/mission/tour_vote.h"
#include "docent/task_control/tour_scheduler/task_order.h"
#include "docent/task_control/tour_scheduler/tour_scheduler.h"
#include "docent/task_control/travel_times/visit_watch.h"

namespace docent::task_control {

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
  bool is_point = false;       ///< it is on its way to a point on the map or a room, or there
  std::string place{};         ///< then: the point's name, or the room's id
  bool is_blocked = false;     ///< people are in the way
  bool needs_charge = false;   ///< it must, before it goes on
  bool says_farewell = false;  ///< at the end of a tour
  int charging_min = 0;        ///< [min] until it is charged well enough, in steps of five
  Reason charger_trouble{};    ///< what keeps it from charging: charger_occupied or charger_no_current; none: nothing
  int charge_percent = 100;
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
  void time_of_day(int hour) {
    scheduler_.times().set_hour(hour);
    charge_plan_.set_hour(hour);
  }
  /// @param charge  0..1. @param is_charging  nullopt: the battery does not say
  void battery(double charge, std::optional<bool> is_charging, Time now);
  [[nodiscard]] bool is_battery_silent(Time now) const { return battery_.is_silent(now); }
  /// Why the staff were called, and still must come, in English; empty: they need not.
  [[nodiscard]] std::string staff_call(Time now) const;
  /// The Web's visitors vote for a tour; every `vote_every`th is theirs ([Minerva2000] 6.4), and one that they want
  /// while nobody else wants anything. @param round  a UUIDv7, the id of its request. @param tour  empty: no votes yet
  void votes(const std::string& round, const std::string& tour, Time now);
  /// @param has_company  people are near
  void company(bool has_company) { has_company_ = has_company; }
  /// Once or twice a second.
  void tick(Time now);

  [[nodiscard]] const TaskOrder& task() const { return task_; }
  [[nodiscard]] MissionSummary summary(Time now);
  [[nodiscard]] MissionMemory memory() const;
  [[nodiscard]] const TourScheduler& scheduler() const { return scheduler_; }
  /// A request that was closed long ago, for somebody who asks for it again.
  void show_again(BoardEntry entry) { scheduler_.board().show_again(std::move(entry)); }
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
  /// Begins the visit of one of `choices()`; false: it is none. @pre no visit is under way.
  [[nodiscard]] bool begin_visit_to(const std::string& exhibit_id, Time now);
  /// Of which exhibits one may be visited next (TourScheduler::choices).
  [[nodiscard]] std::vector<std::string> choices(Time now) { return scheduler_.choices(position(), now); }
  /// The visit under way has ended (TourScheduler::finish_visit). @pre one is under way.
  void finish_visit(bool is_success, const Reason& reason, Time now) {
    scheduler_.finish_visit(is_success, reason, now);
  }
  /// Gives the visit under way to the executive, once more after it was suspended.
  void order_visit(Time now);
  /// Stops what is under way. A visit waits again, as if it had never begun.
  void stop(Time now);
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
  void relocalize();
  /// It knows its place again.
  void end_relocalizing(Time now);
  /// Any action that the executive knows; whatever was under way is over.
  void order_action(TaskOrder order, Time now);
  /// As it is now, for the order of an action: the visit's language, else the museum's own.
  [[nodiscard]] std::string language() const;
  [[nodiscard]] Point2 position() const;
  /// What comes next takes more charge than there is.
  void need_charge(const std::string& why, Time now);

 private:
  void decide(Time now);
  /// Requests the tour with the most votes when it is its turn.
  void take_vote(Time now);
  /// Times the drive and the visit of the present task.
  void learn(TaskStatus status, Time now);
  void start_task(Activity activity, TaskOrder order);
  /// The way home or to the charger is over.
  void note_rest(TaskKind kind, bool is_done, const Reason& reason, Time now);
  /// Visitors do not want the stop under way: the tour goes on at the next one.
  void skip(const VisitorRequest& request, Time now);
  /// Ends a visit that nobody wants any more, and the robot's way there.
  void drop_unwanted_visit(Time now);
  /// From now on its way to the visit under way is timed.
  void set_out(Time now);
  [[nodiscard]] bool is_blocked() const { return task_state_ == TaskStatus::driving && !task_reason_.is_none(); }
  [[nodiscard]] bool may_interrupt() const;
  [[nodiscard]] std::string visited_exhibit() const;  ///< empty: no visit is under way
  [[nodiscard]] MissionPhase phase(Time now) const;
  [[nodiscard]] bool is_lost(Time now) const;
  [[nodiscard]] bool charges() const { return must_charge_ || tops_up_; }
  [[nodiscard]] Pose2 resting_place() const;
  /// Charge left [share] after the way to the charger and what is kept in reserve; +infinity: the battery never spoke.
  [[nodiscard]] double spare(Time now) const;
  /// How long it may be busy before it must charge [s].
  [[nodiscard]] double budget_s(Time now) const;
  /// Charge with which it serves who waits.
  [[nodiscard]] double enough_to_serve() const;
  void watch_battery(Time now);
  [[nodiscard]] const std::vector<std::string>& agenda(Time now);
  [[nodiscard]] bool is_at_charger() const;
  [[nodiscard]] bool has_contact(Time now) const;
  [[nodiscard]] Reason charger_trouble() const;

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
  StaffCall staff_;
  ChargePlan charge_plan_;
  bool must_charge_;            ///< too little is left to go on
  bool backs_off_ = false;      ///< goes home before it docks anew: its charger gives no current
  bool tops_up_ = false;        ///< charges, or goes to its charger, whenever nobody wants anything
  std::string broken_exhibit_;  ///< what was broken off for the charge that comes
  std::string broken_tour_;
  bool is_resting_ = false;  ///< arrived at home, nothing has happened since
  bool has_company_ = false;
  TourVote vote_;
  Time mingle_not_before_{};
  Time home_not_before_{};           ///< nor to the charger
  std::vector<std::string> agenda_;  ///< it is costly, so it is made anew only when board or task have changed
  std::uint64_t agenda_revision_ = 0;
  std::string agenda_task_ = "none yet";
};

}  // namespace docent::task_control
