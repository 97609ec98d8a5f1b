// The primitive actions of Mission, from which a planner chooses.
#include <utility>

#include "docent/task_control/mission/mission.h"

namespace docent::task_control {

void Mission::order_action(TaskOrder order, Time now) {
  is_resting_ = is_resting_ && order.kind == TaskKind::mingle;
  start_task(Activity::action, std::move(order));
  const auto& visit = scheduler_.state().visit;
  if (visit && visit->exhibit_id == task_.exhibit_id && is_same(visit->map_from_base, task_.map_from_base))
    set_out(now);
}

void Mission::stop(Time now) {
  if (scheduler_.state().visit) scheduler_.suspend_visit(now);
  start_task(Activity::none, {});
}

std::string Mission::language() const {
  const auto& visit = scheduler_.state().visit;
  return visit ? visit->language : scheduler_.programme().languages.front();
}

std::string Mission::visited_exhibit() const {
  const auto& visit = scheduler_.state().visit;
  return visit ? visit->exhibit_id : "";
}

bool Mission::begin_visit(Time now) {
  if (!has_company_) scheduler_.let_go_broken_tour(now);
  if (!scheduler_.begin_visit(position(), now, budget_s(now))) return false;
  must_charge_ = false;
  order_visit(now);
  return true;
}

bool Mission::begin_visit_to(const std::string& exhibit_id, Time now) {
  if (!has_company_) scheduler_.let_go_broken_tour(now);
  if (!scheduler_.begin_visit_to(exhibit_id, position(), now)) return false;
  must_charge_ = false;
  return true;
}

void Mission::end_relocalizing(Time now) {
  scheduler_.note({EventKind::localized, "", was_ever_localized_ ? "found itself again" : "woke up",
                   to_seconds(now - lost_since_)});
  was_ever_localized_ = true;
  if (activity_ == Activity::relocalize) start_task(Activity::none, {});
}

void Mission::need_charge(const std::string& why, Time now) {
  must_charge_ = true;
  scheduler_.note({EventKind::battery_low, "", why, battery_.charge(now).value_or(1.0)});
}

void Mission::break_off_to_charge(Time now) {
  const SchedulerState& schedule = scheduler_.state();
  broken_exhibit_ = schedule.visit ? schedule.visit->exhibit_id : "";
  broken_tour_ = schedule.tour ? schedule.tour->tour_id : "";
  scheduler_.break_off(ReasonWord::battery_low, now);
  start_task(Activity::none, {});
}

void Mission::go_home(Time now) {
  if (activity_ == Activity::home || is_resting_ || now < home_not_before_) return;
  const Pose2 place = scheduler_.programme().home;
  if (!params_.goes_home || distance(position(), place.position()) <= params_.at_home_m) {
    is_resting_ = true;
    return;
  }
  start_task(Activity::home, {"", TaskKind::home, "", place, scheduler_.programme().languages.front(), false, ""});
}

void Mission::mingle(Time now) {
  if (activity_ == Activity::mingle || now < mingle_not_before_) return;
  const Point2 here = position();
  start_task(Activity::mingle,
             {"", TaskKind::mingle, "", {here.x, here.y, {}}, scheduler_.programme().languages.front(), false, ""});
}

void Mission::go_charging(Time now) {
  is_resting_ = false;
  if (activity_ == Activity::charge || has_contact(now) || now < home_not_before_) return;
  const Pose2 home = scheduler_.programme().home;
  backs_off_ = backs_off_ && distance(position(), home.position()) > params_.at_home_m;
  if (backs_off_ && activity_ == Activity::home) return;
  if (backs_off_)
    return start_task(Activity::home,
                      {"", TaskKind::home, "", home, scheduler_.programme().languages.front(), false, ""});
  start_task(Activity::charge, order_to_charge());
}

TaskOrder Mission::order_to_charge() {
  const Programme& programme = scheduler_.programme();
  return {"",
          TaskKind::charge,
          std::exchange(broken_exhibit_, ""),
          programme.charger.value_or(programme.home),
          programme.languages.front(),
          false,
          std::exchange(broken_tour_, "")};
}

void Mission::relocalize() {
  start_task(Activity::relocalize,
             {"", TaskKind::relocalize, "", {}, scheduler_.programme().languages.front(), false, ""});
  is_resting_ = false;
  lost_since_ = localization_changed_;
  scheduler_.note({EventKind::relocalizing, scheduler_.state().visit ? scheduler_.state().visit->exhibit_id : "",
                   was_ever_localized_ ? "lost" : "waking up"});
}

void Mission::order_visit(Time now) {
  const Visit& visit = *scheduler_.state().visit;
  const bool offer_more = params_.schedule.offer_more && visit.asks && !scheduler_.is_in_a_hurry(now);
  start_task(Activity::visit, {"", visit.task_kind(), visit.exhibit_id, visit.map_from_base, visit.language,
                               offer_more && !visit.is_point, visit.tour_id});
  is_resting_ = false;
  home_not_before_ = {};
  set_out(now);
}

void Mission::set_out(Time now) {
  const Visit& visit = *scheduler_.state().visit;
  if (visit.is_point) return;  // nobody learns ways to it
  if (!position_) return;      // nobody knows from where it sets out
  watch_.set_out(place_at(scheduler_.programme(), *position_), place_name({visit.exhibit_id, visit.viewpoint}),
                 scheduler_.way_length(*position_, visit.map_from_base.position()), now);
}

void Mission::say_farewell() {
  const Farewell& farewell = *scheduler_.state().farewell;
  const Point2 here = position();
  start_task(Activity::farewell,
             {"", TaskKind::farewell, "", {here.x, here.y, {}}, farewell.language, false, farewell.tour_id});
  is_resting_ = false;
}

}  // namespace docent::task_control
