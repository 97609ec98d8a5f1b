#include "docent/task_control/tour_scheduler/mission.h"

#include <algorithm>
#include <utility>

namespace docent {

Result<void> MissionParams::validate() const {
  if (auto valid = schedule.validate(); !valid) return valid;
  if (!(lost_after_s >= 0.0)) return fail("mission.lost_after_s must be >= 0");
  if (!(localized_after_s >= 0.0)) return fail("mission.localized_after_s must be >= 0");
  if (!(at_home_m > 0.0)) return fail("mission.at_home_m must be > 0");
  if (!(home_retry_s >= 0.0)) return fail("mission.home_retry_s must be >= 0");
  if (!(battery_low >= 0.0 && battery_low <= 1.0)) return fail("mission.battery_low must be in 0..1");
  if (!(battery_full > battery_low && battery_full <= 1.0))
    return fail("mission.battery_full must be in battery_low..1");
  return {};
}

Mission::Mission(const MissionParams& params, Programme programme, TravelDistance travel, MissionMemory memory,
                 Time now)
    : params_{params},
      scheduler_{params.schedule, std::move(programme), std::move(travel), std::move(memory.schedule), now},
      deployment_{std::move(memory.deployment)},
      next_task_{memory.next_task},
      task_{std::move(memory.task)},
      localization_changed_{now},
      lost_since_{now} {
  // The running visit goes on under its old task id, so that an executive that works on it is not disturbed.
  if (const auto& visit = scheduler_.state().visit) {
    activity_ = Activity::visit;
    if (task_.kind != "visit" || !is_same(task_.map_from_base, visit->map_from_base)) start_visit(now);
  } else if (task_.kind == "home" && is_same(task_.map_from_base, scheduler_.programme().home)) {
    activity_ = Activity::home;
  } else {
    task_ = {};
  }
}

void Mission::submit(VisitorRequest request, Time now) {
  scheduler_.submit(std::move(request), conditions_, now);
  if (activity_ == Activity::visit && scheduler_.is_visit_unwanted() && may_interrupt()) {
    scheduler_.drop_visit(now);
    start_task(Activity::none, {});
  }
  decide(now);
}

void Mission::report(const std::string& task_id, const std::string& state, const std::string& reason, Time now) {
  if (task_id.empty() || task_id != task_.id) return;
  task_state_ = state;
  task_reason_ = reason;
  const bool is_over = state == "done" || state == "failed";
  if (activity_ == Activity::visit) {
    if (state == "explaining" || state == "asking") scheduler_.close_visit();
    if (is_over) {
      scheduler_.finish_visit(state == "done", reason, now);
      start_task(Activity::none, {});
    }
  } else if (activity_ == Activity::home && is_over) {
    start_task(Activity::none, {});
    if (state == "done") {
      is_resting_ = true;
      scheduler_.note({"home", "", reason});
    } else {
      home_not_before_ = now + seconds(params_.home_retry_s);
      scheduler_.note({"home_failed", "", reason});
    }
  }
  decide(now);
}

void Mission::localization(bool is_localized, Point2 position, Time now) {
  if (is_localized != is_localized_) {
    is_localized_ = is_localized;
    localization_changed_ = now;
  }
  if (is_localized) position_ = position;
  decide(now);
}

void Mission::limits(bool is_open, const std::string& mode) {
  conditions_.is_open = is_open;
  conditions_.mode = mode;
}

void Mission::battery(double fraction) {
  if (!conditions_.battery_low && fraction < params_.battery_low) {
    conditions_.battery_low = true;
    is_resting_ = false;
    scheduler_.note({"battery_low", "", "", fraction});
  } else if (conditions_.battery_low && fraction >= params_.battery_full) {
    conditions_.battery_low = false;
    is_resting_ = false;
    scheduler_.note({"battery_full", "", "", fraction});
  }
}

void Mission::tick(Time now) { decide(now); }

bool Mission::is_lost(Time now) const {
  return !is_localized_ && now - localization_changed_ >= seconds(params_.lost_after_s);
}

bool Mission::may_interrupt() const { return task_state_ != "explaining" && task_state_ != "asking"; }

Pose2 Mission::resting_place() const {
  const Programme& programme = scheduler_.programme();
  return conditions_.battery_low && programme.charger ? *programme.charger : programme.home;
}

Point2 Mission::position() const { return position_.value_or(scheduler_.programme().home.position()); }

void Mission::decide(Time now) {
  if (!is_localized_) {
    decide_when_lost(now);
    return;
  }
  if (activity_ == Activity::relocalize || !was_ever_localized_) {
    if (now - localization_changed_ < seconds(params_.localized_after_s)) return;
    scheduler_.note(
        {"localized", "", was_ever_localized_ ? "found itself again" : "woke up", to_seconds(now - lost_since_)});
    was_ever_localized_ = true;
    if (activity_ == Activity::relocalize) {
      start_task(Activity::none, {});
      if (scheduler_.state().visit) start_visit(now);  // what was suspended goes on
    }
  }
  if (activity_ == Activity::visit) return;
  if (!conditions_.battery_low) {
    if (scheduler_.begin_visit(position(), now)) {
      start_visit(now);
      return;
    }
  }
  if (activity_ == Activity::home || is_resting_ || now < home_not_before_) return;
  const Pose2 place = resting_place();
  if (distance(position(), place.position()) <= params_.at_home_m) {
    is_resting_ = true;
    return;
  }
  start_task(Activity::home, {"", "home", "", place, scheduler_.programme().languages.front(), false, ""});
}

void Mission::decide_when_lost(Time now) {
  if (activity_ == Activity::relocalize || !is_lost(now)) return;
  if (activity_ == Activity::visit && !may_interrupt()) return;  // it stands and talks: first things first
  start_task(Activity::relocalize, {"", "relocalize", "", {}, scheduler_.programme().languages.front(), false, ""});
  is_resting_ = false;
  lost_since_ = localization_changed_;
  scheduler_.note({"relocalizing", scheduler_.state().visit ? scheduler_.state().visit->exhibit_id : "",
                   was_ever_localized_ ? "lost" : "waking up"});
}

void Mission::start_visit(Time now) {
  const Visit& visit = *scheduler_.state().visit;
  const bool offer_more = params_.offer_more && !scheduler_.is_in_a_hurry(now);
  start_task(Activity::visit,
             {"", "visit", visit.exhibit_id, visit.map_from_base, visit.language, offer_more, visit.tour_id});
  is_resting_ = false;
}

void Mission::start_task(Activity activity, TaskOrder order) {
  activity_ = activity;
  task_ = std::move(order);
  if (activity != Activity::none) task_.id = deployment_ + "-" + std::to_string(next_task_++);
  task_state_.clear();
  task_reason_.clear();
}

MissionSummary Mission::summary(Time now) const {
  MissionSummary summary;
  const SchedulerState& schedule = scheduler_.state();
  summary.counters = schedule.counters;
  summary.agenda = scheduler_.agenda(position(), now);
  if (schedule.tour) summary.tour_id = schedule.tour->tour_id;
  if (schedule.visit) {
    summary.exhibit_id = schedule.visit->exhibit_id;
  } else if (!summary.agenda.empty()) {
    summary.exhibit_id = summary.agenda.front();
  }
  summary.is_charging = conditions_.battery_low;
  summary.is_blocked = task_state_ == "driving" && !task_reason_.empty();
  switch (activity_) {
    case Activity::visit:
      summary.phase = task_state_ == "explaining" || task_state_ == "asking" ? task_state_ : "driving";
      break;
    case Activity::home:
      summary.phase = "going_home";
      break;
    case Activity::relocalize:
      summary.phase = was_ever_localized_ ? "relocalizing" : "waking";
      break;
    case Activity::none:
      summary.phase = !was_ever_localized_ ? "waking" : is_resting_ ? "idle" : "waiting";
      break;
  }
  return summary;
}

MissionMemory Mission::memory() const { return {scheduler_.state(), deployment_, next_task_, task_}; }

}  // namespace docent
