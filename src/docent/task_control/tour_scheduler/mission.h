#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "docent/task_control/tour_scheduler/tour_scheduler.h"

namespace docent {

/// One thing to do, for the executive.
struct TaskOrder {
  std::string id;    ///< empty: nothing to do
  std::string kind;  ///< visit, home, relocalize
  std::string exhibit_id;
  Pose2 map_from_base;  ///< where to stand
  std::string language;
  bool offer_more = true;
  std::string tour_id;
};

/// Section `mission` of robot.yaml.
struct MissionParams {
  SchedulerParams schedule;
  double lost_after_s = 3.0;       ///< [s] >= 0 without localization before a tour is suspended
  double localized_after_s = 1.0;  ///< [s] >= 0 with localization before it is resumed
  double at_home_m = 0.7;          ///< [m] > 0: so near, the robot is at home
  double home_retry_s = 30.0;      ///< [s] >= 0 after a failed way home
  double battery_low = 0.15;       ///< 0..1: below, nothing is taken on and the robot goes to its charger
  double battery_full = 0.8;       ///< 0..1, > battery_low: from here on it works again
  bool offer_more = true;          ///< ask at each exhibit, unless others wait for long: more, or next?
  template <class V>
  void visit(V& v) {
    schedule.visit(v);
    v("lost_after_s", lost_after_s);
    v("localized_after_s", localized_after_s);
    v("at_home_m", at_home_m);
    v("home_retry_s", home_retry_s);
    v("battery_low", battery_low);
    v("battery_full", battery_full);
    v("offer_more", offer_more);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// All that must survive a restart of the mission.
struct MissionMemory {
  SchedulerState schedule;
  std::string deployment;       ///< begins every task id: no task of another life of the database is taken for ours
  std::uint64_t next_task = 1;  ///< number of the next task
  TaskOrder task;               ///< the present one
};

/// What the robot is about. Phases as in docent_msgs/MissionState.
struct MissionSummary {
  std::string phase;
  std::string tour_id;
  std::string exhibit_id;
  bool is_blocked = false;  ///< people are in the way
  bool is_charging = false;
  Counters counters;
  std::vector<std::string> agenda;
};

/// Decides what the robot does, from waking up to going home: serves the requests on the board one visit after the
/// other, returns home when none is open ([Rhino1999] Table 4, `internet-tourguide`), finds itself again when it is
/// lost, rests when the battery is low. Deterministic; knows nothing of messages and files.
class Mission {
 public:
  Mission(const MissionParams& params, Programme programme, TravelDistance travel, MissionMemory memory, Time now);

  void submit(VisitorRequest request, Time now);
  /// How a task goes: driving, explaining, asking, done, failed. Reports of other tasks than the present are ignored.
  void report(const std::string& task_id, const std::string& state, const std::string& reason, Time now);
  /// @param position  best guess [m], map
  void localization(bool is_localized, Point2 position, Time now);
  void limits(bool is_open, const std::string& mode);
  void battery(double fraction);  ///< 0..1
  /// Once or twice a second.
  void tick(Time now);

  [[nodiscard]] const TaskOrder& task() const { return task_; }
  [[nodiscard]] MissionSummary summary(Time now) const;
  [[nodiscard]] MissionMemory memory() const;
  [[nodiscard]] TourScheduler& scheduler() { return scheduler_; }
  [[nodiscard]] std::vector<Happening> take_happenings() { return scheduler_.take_happenings(); }

 private:
  enum class Activity { none, visit, home, relocalize };

  void decide(Time now);
  void decide_when_lost(Time now);
  void start_task(Activity activity, TaskOrder order);
  void start_visit(Time now);
  [[nodiscard]] bool may_interrupt() const;
  [[nodiscard]] bool is_lost(Time now) const;
  [[nodiscard]] Pose2 resting_place() const;
  [[nodiscard]] Point2 position() const;

  MissionParams params_;
  TourScheduler scheduler_;
  std::string deployment_;
  std::uint64_t next_task_;
  TaskOrder task_;
  Activity activity_ = Activity::none;
  std::string task_state_;
  std::string task_reason_;

  bool is_localized_ = false;
  bool was_ever_localized_ = false;
  Time localization_changed_;
  Time lost_since_;
  std::optional<Point2> position_;
  Conditions conditions_;
  bool is_resting_ = false;  ///< arrived at the resting place, nothing has happened since
  Time home_not_before_{};
};

}  // namespace docent
