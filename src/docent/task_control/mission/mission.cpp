#include "docent/task_control/mission/mission.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace docent::task_control {
Mission::Mission(const MissionParams& params, Programme programme, TravelDistance travel, MissionMemory memory,
                 std::unique_ptr<Planner> planner, Time now)
    : params_{params},
      scheduler_{params.schedule, std::move(programme), std::move(travel), std::move(memory.schedule), now},
      planner_{std::move(planner)},
      deployment_{std::move(memory.deployment)},
      next_task_{memory.next_task},
      task_{std::move(memory.task)},
      localization_changed_{now},
      lost_since_{now},
      battery_{params.drain_per_s, params.charge_per_s},
      staff_{params.staff},
      charge_plan_{params.charging},
      must_charge_{memory.must_charge} {
  charge_plan_.demand().restore(memory.lessons);
  std::erase_if(memory.lessons, [](const LessonRow& row) { return row.key.kind == LessonKind::demand; });
  scheduler_.times().restore(memory.lessons);
  conditions_.takes_points = planner_->serves_points();
  // What is under way goes on under its old task id, so that an executive that works on it is not disturbed.
  TaskOrder ordered = task_;
  const bool orders_actions = planner_->restore(memory.planner, ordered);
  if (task_.kind == TaskKind::farewell && scheduler_.state().farewell) {
    activity_ = Activity::farewell;
  } else if (orders_actions) {
    task_ = std::move(ordered);
    if (!task_.id.empty()) {
      activity_ = Activity::action;
    } else {
      stop(now);
    }
  } else if (const auto& visit = scheduler_.state().visit) {
    activity_ = Activity::visit;
    if (task_.kind != visit->task_kind() || !is_same(task_.map_from_base, visit->map_from_base)) order_visit(now);
  } else if (task_.kind == TaskKind::home && is_same(task_.map_from_base, scheduler_.programme().home)) {
    activity_ = Activity::home;
  } else if (task_.kind == TaskKind::charge && is_same(task_.map_from_base, resting_place())) {
    activity_ = Activity::charge;
  } else {
    task_ = {};
  }
}

void Mission::submit(VisitorRequest request, Time now) {
  if (request.kind == RequestKind::skip) return skip(request, now);
  conditions_.delay = must_charge_ ? ReasonWord::charging_first : Reason{};
  conditions_.robot = position();
  scheduler_.submit(std::move(request), conditions_, now);
  decide(now);
}

void Mission::report(const std::string& task_id, std::optional<TaskStatus> state, const Reason& reason, Time now,
                     bool took_long) {
  if (task_id.empty() || task_id != task_.id) return;
  task_state_ = state;
  task_reason_ = reason;
  if (state) learn(*state, now);
  const bool is_over = state == TaskStatus::done || state == TaskStatus::failed;
  if (activity_ == Activity::visit) {
    if (state == TaskStatus::explaining || state == TaskStatus::asking) scheduler_.close_visit();
    if (is_over) {
      scheduler_.finish_visit(state == TaskStatus::done, reason, now);
      start_task(Activity::none, {});
    }
  } else if (activity_ == Activity::action) {
    const bool speaks = state == TaskStatus::explaining || state == TaskStatus::asking;
    if (speaks && task_.exhibit_id == visited_exhibit()) scheduler_.close_visit();
    if (is_over) {
      const TaskOrder order = task_;
      start_task(Activity::none, {});
      if (order.kind == TaskKind::home || order.kind == TaskKind::charge)
        note_rest(*order.kind.value(), state == TaskStatus::done, reason, now);
      planner_->outcome(*this, order, {state == TaskStatus::done, took_long, reason}, now);
    }
  } else if (activity_ == Activity::farewell && is_over) {
    scheduler_.finish_farewell(now);
    start_task(Activity::none, {});
  } else if (activity_ == Activity::mingle && is_over) {
    mingle_not_before_ = now + seconds(params_.mingle_pause_s);
    start_task(Activity::none, {});
  } else if ((activity_ == Activity::home || activity_ == Activity::charge) && is_over) {
    const bool is_home = activity_ == Activity::home;
    start_task(Activity::none, {});
    note_rest(is_home ? TaskKind::home : TaskKind::charge, state == TaskStatus::done, reason, now);
  }
  decide(now);
}

void Mission::note_rest(TaskKind kind, bool is_done, const Reason& reason, Time now) {
  const bool is_home = kind == TaskKind::home;
  is_resting_ = is_done && is_home;
  backs_off_ = backs_off_ && !is_home;
  if (!is_home && is_done) staff_.docked();
  if (!is_home && !is_done) staff_.failed(reason);
  // At the charger the battery has a moment to say that it charges.
  const double retry_s = is_home ? params_.home_retry_s : staff_.retry_s(params_.home_retry_s);
  const bool is_at_rest = is_done && !staff_.has_no_current();
  if (!is_resting_) home_not_before_ = now + seconds(is_at_rest ? params_.contact_s : retry_s);
  if (!is_done && !is_home && spare(now) >= 0.0) must_charge_ = false;  // people stand there: it rather serves
  const EventKind arrival = is_home ? EventKind::home : EventKind::charger;
  const EventKind failure = is_home ? EventKind::home_failed : EventKind::charger_failed;
  scheduler_.note({is_done ? arrival : failure, "", reason.text()});
}

void Mission::localization(bool is_localized, Point2 position, Time now) {
  if (is_localized != is_localized_) {
    is_localized_ = is_localized;
    localization_changed_ = now;
  }
  if (is_localized) position_ = position;
  decide(now);
}

void Mission::limits(bool is_open, std::optional<OperatingMode> mode) {
  conditions_.is_open = is_open;
  conditions_.mode = mode;
}

void Mission::battery(double charge, std::optional<bool> is_charging, Time now) {
  battery_.report(charge, is_charging, now);
  decide(now);
}

void Mission::tick(Time now) {
  const SchedulerState& schedule = scheduler_.state();
  charge_plan_.demand().observe(charge_plan_.hour(), schedule.visit || schedule.tour || scheduler_.is_anything_due(now),
                                now);
  decide(now);
}

bool Mission::is_lost(Time now) const {
  return !is_localized_ && now - localization_changed_ >= seconds(params_.lost_after_s);
}

bool Mission::may_interrupt() const {
  return task_state_ != TaskStatus::explaining && task_state_ != TaskStatus::asking;
}

Pose2 Mission::resting_place() const {
  const Programme& programme = scheduler_.programme();
  return charges() && programme.charger ? *programme.charger : programme.home;
}

double Mission::enough_to_serve() const {
  const Waiting waiting = waiting_on(scheduler_.state().board);
  return std::min(params_.battery_full,
                  params_.battery_low + charge_plan_.gain_for(waiting, params_.battery_gain, battery_.drain_per_s()));
}

double Mission::spare(Time now) const {
  const auto charge = battery_.charge(now);
  if (!charge) return std::numeric_limits<double>::infinity();
  const SchedulerState& schedule = scheduler_.state();
  const double reserve =
      schedule.visit || schedule.tour ? params_.reserve_of_begun * params_.battery_low : params_.battery_low;
  const Programme& programme = scheduler_.programme();
  const Point2 place = programme.charger.value_or(programme.home).position();
  const double way_s = scheduler_.way_duration(position(), place, now);
  // Where no way is known, the reserve must do.
  return *charge - reserve - (std::isfinite(way_s) ? battery_.drain_per_s() * way_s : 0.0);
}

double Mission::budget_s(Time now) const {
  const auto charge = battery_.charge(now);
  const bool is_at_its_best = !charge || *charge >= params_.battery_full || !scheduler_.programme().charger;
  return is_at_its_best ? std::numeric_limits<double>::infinity() : spare(now) / battery_.drain_per_s();
}

bool Mission::is_at_charger() const {
  const auto& charger = scheduler_.programme().charger;
  return charger && distance(position(), charger->position()) <= params_.at_charger_m;
}

bool Mission::has_contact(Time now) const {
  return battery_.is_charging(now).value_or(is_at_charger()) && !staff_.has_no_current();
}

Reason Mission::charger_trouble() const {
  const bool is_now = activity_ == Activity::charge && task_reason_.word() == ReasonWord::charger_occupied;
  const Reason& why = is_now ? task_reason_ : staff_.trouble();
  const bool is_of_charger = why.word() == ReasonWord::charger_occupied || why.word() == ReasonWord::charger_no_current;
  return is_of_charger ? why : Reason{};
}

std::string Mission::staff_call(Time now) const {
  const std::string why = staff_.told();
  const auto charge = battery_.charge(now);
  return why.empty() || !charge ? why : std::to_string(std::lround(100.0 * *charge)) + " % left, " + why;
}

void Mission::watch_battery(Time now) {
  if (!is_at_charger()) battery_.is_away_from_charger(now);
  const auto charge = battery_.charge(now);
  if (!charge) return;
  if (*charge >= params_.battery_full) {
    if (must_charge_ || tops_up_) scheduler_.note({EventKind::battery_full, "", "", *charge});
    must_charge_ = false;
    tops_up_ = false;
  } else if (!must_charge_ && spare(now) < 0.0) {
    must_charge_ = true;
    is_resting_ = false;
    scheduler_.note({EventKind::battery_low, "", "", *charge});
  }
  if (!scheduler_.programme().charger) return;
  if (*charge < params_.battery_full - charge_plan_.missing_in_gap(params_.battery_gain)) tops_up_ = true;
  const bool is_there = is_at_charger() && battery_.is_charging(now).value_or(true) && !battery_.is_silent(now);
  const bool was_in_vain = staff_.has_no_current();
  if (auto call = staff_.watch(*charge, is_there, *charge >= params_.battery_full, now))
    scheduler_.note(std::move(*call));
  if (staff_.has_no_current() && !was_in_vain) {
    backs_off_ = staff_.failures() == 1;
    home_not_before_ = now + seconds(staff_.retry_s(params_.home_retry_s));
    scheduler_.note({EventKind::charger_failed, "", to_text(ReasonWord::charger_no_current)});
  }
}

Point2 Mission::position() const { return position_.value_or(scheduler_.programme().home.position()); }

void Mission::drop_unwanted_visit(Time now) {
  if (!scheduler_.is_visit_unwanted() || !may_interrupt()) return;
  const TaskOrder order = task_;
  const bool was_ordered = activity_ == Activity::action;
  const bool is_for_visit = activity_ == Activity::visit || (was_ordered && order.exhibit_id == visited_exhibit());
  scheduler_.drop_visit(now);
  if (!is_for_visit) return;
  start_task(Activity::none, {});
  if (was_ordered) planner_->outcome(*this, order, {false, false, ReasonWord::cancelled}, now);
}

void Mission::skip(const VisitorRequest& request, Time now) {
  const TaskOrder order = task_;
  if (!scheduler_.decline_stop(request, now)) return;
  const bool was_ordered = activity_ == Activity::action;
  if (activity_ == Activity::visit || (was_ordered && order.exhibit_id == request.target)) {
    start_task(Activity::none, {});
    if (was_ordered) planner_->outcome(*this, order, {false, false, ReasonWord::cancelled}, now);
  }
  decide(now);
}

void Mission::votes(const std::string& round, const std::string& tour, Time now) {
  vote_.told(round, tour, scheduler_.state().board.find(round) != nullptr, now);
}

void Mission::take_vote(Time now) {
  const SchedulerState& schedule = scheduler_.state();
  const bool is_open = conditions_.is_open && conditions_.mode.value_or(OperatingMode::open) == OperatingMode::open;
  if (!vote_.is_open() || !is_open || schedule.tour) return;
  const bool is_turn = schedule.counters.tours_since_vote + 1 >= static_cast<std::uint32_t>(params_.vote_every);
  const bool is_idle =
      is_resting_ && schedule.board.open_count() == 0 && vote_.lasts(now) >= seconds(params_.vote_idle_s);
  if (!is_turn && !is_idle) return;
  const TourVote::Winner winner = vote_.take();
  scheduler_.submit({winner.round, now, RequestSource::vote, "", RequestKind::tour, winner.tour, -1,
                     scheduler_.programme().languages.front()},
                    conditions_, now);
}

void Mission::decide(Time now) {
  watch_battery(now);
  take_vote(now);
  drop_unwanted_visit(now);
  planner_->decide(*this, now);
}

Situation Mission::situation(Time now) const {
  const SchedulerState& schedule = scheduler_.state();
  Situation seen;
  seen.activity = activity_;
  seen.may_interrupt = may_interrupt();
  seen.is_localized = is_localized_;
  seen.is_lost = is_lost(now);
  seen.is_settled = is_localized_ && now - localization_changed_ >= seconds(params_.localized_after_s);
  seen.was_ever_localized = was_ever_localized_;
  seen.has_visit = schedule.visit.has_value();
  seen.has_tour = schedule.tour.has_value();
  seen.has_farewell = schedule.farewell.has_value();
  seen.is_anything_due = scheduler_.is_anything_due(now);
  seen.is_open = conditions_.is_open && conditions_.mode != OperatingMode::closed;
  seen.is_blocked = is_blocked();
  seen.charge = battery_.charge(now);
  seen.is_charging = is_at_charger() && has_contact(now);
  seen.is_charged = !charges() || (seen.is_anything_due && seen.charge.value_or(1.0) >= enough_to_serve());
  seen.has_charger = scheduler_.programme().charger.has_value();
  seen.is_low_soon = now >= home_not_before_ && battery_.charge(now).value_or(1.0) < params_.battery_soon &&
                     charge_plan_.may_charge_before(waiting_on(schedule.board));
  seen.must_charge = must_charge_;
  seen.charges = charges();
  seen.may_mingle = params_.mingles && is_resting_ && has_company_ && seen.is_open &&
                    conditions_.mode.value_or(OperatingMode::open) == OperatingMode::open;
  seen.may_serve = !must_charge_ || battery_.charge(now).value_or(1.0) >= enough_to_serve();
  return seen;
}

void Mission::learn(TaskStatus status, Time now) {
  const VisitWatch::Seen seen = watch_.report(status, now);
  if (seen.way) scheduler_.times().learn_way(seen.way->from, seen.way->to, seen.way->way_m, seen.way->seconds, now);
  // Where the robot waits at each exhibit, the reports do not tell waiting from speaking.
  if (!seen.visit || conditions_.mode == OperatingMode::web) return;
  const ProgrammeExhibit* exhibit = scheduler_.programme().find_exhibit(task_.exhibit_id);
  if (exhibit == nullptr) return;
  const SpokenLength spoken = exhibit->length_in(task_.language);
  const double known_s = spoken.short_s + (seen.visit->course == VisitCourse::heard_more ? spoken.long_s : 0.0);
  scheduler_.times().learn_visit(seen.visit->course, seen.visit->seconds - known_s);
}

void Mission::start_task(Activity activity, TaskOrder order) {
  watch_.forget();
  activity_ = activity;
  task_ = std::move(order);
  if (activity != Activity::none) task_.id = deployment_ + "-" + std::to_string(next_task_++);
  task_state_.reset();
  task_reason_ = {};
}

const std::vector<std::string>& Mission::agenda(Time now) {
  const std::uint64_t revision = scheduler_.state().board.revision();
  if (agenda_revision_ != revision || agenda_task_ != task_.id) agenda_ = scheduler_.agenda(position(), now);
  agenda_revision_ = revision;
  agenda_task_ = task_.id;
  return agenda_;
}

MissionSummary Mission::summary(Time now) {
  MissionSummary summary;
  const SchedulerState& schedule = scheduler_.state();
  summary.counters = schedule.counters;
  summary.agenda = agenda(now);
  if (schedule.tour) summary.tour_id = schedule.tour->tour_id;
  if (schedule.visit) {
    summary.is_point = schedule.visit->is_point;
    (summary.is_point ? summary.place : summary.exhibit_id) = schedule.visit->exhibit_id;
  } else if (!summary.agenda.empty()) {
    summary.exhibit_id = summary.agenda.front();
  }
  summary.needs_charge = must_charge_;
  summary.charger_trouble = charger_trouble();
  if (const auto charge = battery_.charge(now); charge && charges()) {
    summary.charge_percent = static_cast<int>(std::lround(100.0 * *charge));
    const bool is_awaited = scheduler_.is_anything_due(now);
    const double missing = (is_awaited ? enough_to_serve() : params_.battery_full) - *charge;
    summary.charging_min = 5 * static_cast<int>(std::ceil(std::max(0.0, missing) / battery_.charge_per_s() / 300.0));
  }
  summary.is_blocked = is_blocked();
  summary.says_farewell = activity_ == Activity::farewell;
  if (summary.says_farewell) summary.exhibit_id.clear();
  summary.phase = phase(now);
  return summary;
}

MissionPhase Mission::phase(Time now) const {
  switch (activity_) {
    case Activity::visit:
    case Activity::action:
      if (task_.kind == TaskKind::mingle) return MissionPhase::idle;
      if (task_state_ == TaskStatus::asking) return MissionPhase::asking;
      if (task_state_ == TaskStatus::explaining) return MissionPhase::explaining;
      return task_.kind == TaskKind::home || task_.kind == TaskKind::charge ? MissionPhase::going_home
                                                                            : MissionPhase::driving;
    case Activity::farewell:
      return MissionPhase::explaining;
    case Activity::mingle:
      return MissionPhase::idle;
    case Activity::home:
    case Activity::charge:
      return MissionPhase::going_home;
    case Activity::relocalize:
      return was_ever_localized_ ? MissionPhase::relocalizing : MissionPhase::waking;
    case Activity::none:
      break;
  }
  if (!was_ever_localized_) return MissionPhase::waking;
  if (charges() && has_contact(now)) return MissionPhase::charging;
  return is_resting_ ? MissionPhase::idle : MissionPhase::waiting;
}

MissionMemory Mission::memory() const {
  MissionMemory memory{scheduler_.state(),           deployment_, next_task_, task_, must_charge_, planner_->memory(),
                       scheduler_.times().unstored()};
  const auto demand = charge_plan_.demand().unstored();
  memory.lessons.insert(memory.lessons.end(), demand.begin(), demand.end());
  return memory;
}

void Mission::mark_stored() {
  scheduler_.board().mark_stored();
  scheduler_.times().mark_stored();
  charge_plan_.demand().mark_stored();
}

}  // namespace docent::task_control
