#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docent/museum/day_plan.h"
#include "docent/museum/museum.h"
#include "docent/task_control/mission/mission.h"
#include "docent/task_control/mission/mission_store.h"
#include "docent/task_control/mission_service/company.h"

namespace docent::task_control {

/// The executive's question, as people read it.
struct ShownQuestion {
  std::string id;        ///< empty: nothing is asked
  std::string language;  ///< in which it is spoken
  std::vector<std::string> languages;
  std::vector<std::string> texts;    ///< [languages]
  std::vector<std::string> options;  ///< words of Answer
  std::string default_option;
  Time deadline;
  friend bool operator==(const ShownQuestion&, const ShownQuestion&) = default;
};

/// What the robot is about, for everybody.
struct MissionStatus {
  MissionPhase phase = MissionPhase::waking;
  std::string tour_id;
  std::string exhibit_id;
  ShownQuestion question;
  std::uint32_t exhibits_explained = 0;
  std::uint32_t tours_completed = 0;
  std::uint32_t requests_served = 0;
  std::vector<std::string> agenda;
  std::vector<std::string> languages;
  std::vector<std::string> texts;  ///< [languages] one sentence
  friend bool operator==(const MissionStatus&, const MissionStatus&) = default;
};

/// The executive's next task.
struct MissionTask {
  TaskOrder order;
  std::optional<interaction::AttractionAction> style;  ///< of a task that attracts people
};

/// What there is to tell, in this order: all of it is stored.
struct MissionNews {
  std::vector<Happening> happenings;
  std::optional<RequestBoard> board;
  std::optional<interaction::AttractionTrial> trial;  ///< what it was worth to attract people, until now
  std::optional<MissionTask> task;
  std::optional<MissionStatus> status;
};

/// Votes of the Web's visitors for tours.
struct VoteCounts {
  std::string round;
  std::vector<std::string> tours;
  std::vector<std::uint32_t> counts;  ///< [tours]
};

/// The way in and out of a mission: takes requests, votes and reports from strangers, commits what follows from them,
/// and only then says what has changed (architecture 10.9). Deterministic.
class MissionService {
 public:
  /// What a room is called, by its id.
  using RoomName = std::function<museum::Translations(const std::string& id)>;

  /// Museum and company outlive it.
  MissionService(std::unique_ptr<Mission> mission, MissionStore store, const museum::Museum& museum, Company& company,
                 RoomName name_of_room);

  /// All that is known at the start.
  [[nodiscard]] MissionNews begin(Time now) { return flush(now); }
  /// Somebody's wish, perhaps not for the first time.
  [[nodiscard]] MissionNews request(VisitorRequest request, Time now);
  /// The tour that leads is wished for; of two with as many votes the one that is listed first.
  [[nodiscard]] MissionNews votes(const VoteCounts& votes, Time now);
  /// How the executive's task goes.
  /// @param took_long  the visitor asked for more
  [[nodiscard]] MissionNews report(const std::string& task_id, std::optional<TaskStatus> state, const Reason& reason,
                                   const ShownQuestion& question, bool took_long, Time now);
  /// @param position  best guess [m], map
  [[nodiscard]] MissionNews localization(bool is_localized, Point2 position, Time now);
  void limits(bool is_open, std::optional<OperatingMode> mode) { mission_->limits(is_open, mode); }
  /// @param charge  0..1. @param is_charging  nullopt: the battery does not say
  void battery(double charge, std::optional<bool> is_charging, Time now) {
    mission_->battery(charge, is_charging, now);
  }
  /// @param hour  of the day, 0..23
  void time_of_day(int hour) { mission_->time_of_day(hour); }
  /// A daily tour that begins soon; nullopt: none does.
  void expect_daily_tour(std::optional<museum::DailyTour> tour) { daily_tour_ = std::move(tour); }
  /// It tells nobody anything now, and asks nobody.
  [[nodiscard]] bool may_speak(Time now) const;
  /// Twice a second.
  [[nodiscard]] MissionNews tick(Time now);

  /// Why it does not work as it should; empty: it does.
  [[nodiscard]] std::string fault(Time now) const;

 private:
  /// What may be told since the last time; nothing while it cannot be stored.
  [[nodiscard]] MissionNews flush(Time now);
  [[nodiscard]] MissionTask begin_task(const TaskOrder& order);
  [[nodiscard]] MissionStatus status(Time now);

  std::unique_ptr<Mission> mission_;
  MissionStore store_;
  const museum::Museum& museum_;
  Company& company_;
  RoomName name_of_room_;
  ShownQuestion question_;                       ///< of the present task
  std::optional<museum::DailyTour> daily_tour_;  ///< that people shall read of
  bool is_localized_ = false;
  std::string store_fault_;
  // As they were told last; nullopt: never.
  std::optional<std::uint64_t> told_revision_;
  std::optional<std::string> told_task_;
  std::optional<MissionStatus> told_status_;
};

}  // namespace docent::task_control
