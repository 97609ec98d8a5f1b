// Drives of the executive, and docking at the charger.
#include <algorithm>

#include "docent/interaction/speech/sentences.h"
#include "docent/task_control/golex/directive_text.h"
#include "docent/task_control/golex/executive.h"

namespace docent::task_control {
namespace {

constexpr Duration kReportLife = std::chrono::seconds{1};  // avoidance and head speak four times a second and more

}  // namespace

DriveOrder Executive::drive_order() const {
  const TaskOrder& order = memory_.task.order;
  if (under_way(DirectiveKind::relocalize) != nullptr) return {own_id("relocalize"), {}, true};
  if (const auto move = docking_ ? docking_->move() : std::nullopt)
    return {own_id(move->name), move->map_from_base, false, move->position_tolerance, move->heading_tolerance};
  if (stands_by_tag_ || (docking_ && docking_->is_by_tag())) return {};
  const auto* action = decomposition_.find(order.kind.text());
  if (memory_.phase == Phase::idle || memory_.phase == Phase::failed || action == nullptr) return {};
  // After its drive it stays at the place: the goal remains the last one that was begun.
  const std::size_t begun = memory_.phase == Phase::done ? action->size() : static_cast<std::size_t>(memory_.item) + 1;
  const Directive* drive = last_drive(*action, begun);
  if (drive == nullptr) return {};
  const double tolerance = drive->argument == "charger" ? params_.charger_tolerance : DriveOrder{}.position_tolerance;
  if (drive->argument != "charger" || !drives_to_tag_)
    return {own_id(drive->name), order.map_from_base, false, tolerance};
  const Pose2 charger_from_base{-params_.docking.tag_stand_off_m, 0.0, {}};
  return {own_id(drive->name), order.map_from_base * charger_from_base, false, BeforeTag::kPosition,
          BeforeTag::kHeading};
}

std::optional<DriveOrder> Executive::tag_order() const {
  const auto name = docking_ ? docking_->tag_order() : std::nullopt;
  if (!name) return std::nullopt;
  return DriveOrder{own_id(*name), memory_.task.order.map_from_base};
}

void Executive::watch_drive(Time now) {
  const Directive* driven = under_way(DirectiveKind::drive);
  if (driven == nullptr) return;
  if (now - memory_.drive_began > seconds(params_.max_drive_s)) {
    finish(false, ReasonWord::took_too_long);
  } else if (goal_.id == own_id(driven->name)) {
    climb_ladder(now);
  }
}

void Executive::obstacle_report(const ObstacleReport& report, Time now) {
  obstacle_ = report;
  obstacle_time_ = now;
}

void Executive::mood_report(Mood mood, Time now) {
  shown_mood_ = mood;
  shown_at_ = now;
}

bool Executive::docks_next() const {
  const auto* action = decomposition_.find(memory_.task.order.kind.text());
  const auto next = static_cast<std::size_t>(memory_.item) + 1;
  if (action == nullptr || next >= action->size()) return false;
  const std::vector<Directive>& together = (*action)[next].together;
  return std::any_of(together.begin(), together.end(),
                     [](const Directive& directive) { return directive.kind == DirectiveKind::dock; });
}

bool Executive::is_before_occupied_charger() const {
  const Directive* driven = under_way(DirectiveKind::drive);
  return driven != nullptr && driven->argument == "charger" && goal_.is_occupied && docks_next() &&
         (goal_.state == GoalStatus::unreachable || goal_.straight_m <= params_.docking.occupied_near_m);
}

void Executive::climb_ladder(Time now) {
  if (now - obstacle_time_ > kReportLife) obstacle_ = {};
  const bool is_unreachable = goal_.state == GoalStatus::unreachable;
  const bool is_occupied = is_before_occupied_charger();
  const Directive* to_charger = under_way(DirectiveKind::drive);
  const bool is_to_charger = to_charger != nullptr && to_charger->argument == "charger";
  const Point2 place = memory_.task.order.map_from_base.position();
  const bool is_thing = is_to_charger && somebody_.is_thing(place, goal_.is_occupied, now);
  const bool is_thing_there = is_occupied && is_thing;
  const LadderView view{obstacle_.is_hindered,
                        obstacle_.is_unmapped,
                        is_unreachable,
                        goal_.blocked_s,
                        planning::detour_of(goal_.detour),
                        obstacle_.reason.empty() ? goal_.reason : obstacle_.reason,
                        obstacle_.is_thing || is_thing_there,
                        under_way(DirectiveKind::drive) != nullptr && approach_.is_in_vain(now)};
  auto steps = ladder_.step(view, now);
  bool gives_up = false;
  for (const LadderStep& step : steps) {
    if (step.rung == Rung::ask) ask_for_way(now, step.count);
    gives_up = gives_up || step.rung == Rung::give_up;
  }
  actions_.reactions_of = goal_.id;
  actions_.reactions.insert(actions_.reactions.end(), steps.begin(), steps.end());
  const Directive* driven = under_way(DirectiveKind::drive);
  if (driven == nullptr) return;  // a robot that does not know where it is has nothing else to choose
  if (is_thing_there && (is_unreachable || goal_.blocked_s >= params_.docking.occupied_after_s))
    return end(*driven, now);  // docking has ways of its own
  if (!gives_up) return;
  if (is_occupied) return fail_to_charge(ReasonWord::charger_occupied);
  finish(false, is_unreachable ? ReasonWord::no_way : ReasonWord::way_blocked);
}

void Executive::ask_for_way(Time now, int count) {
  const bool is_shown = shown_at_ != Time{} && now - shown_at_ <= kReportLife;
  const Mood mood = is_shown ? shown_mood_ : count == 1 ? Mood::neutral : Mood::sad;
  // The name carries the time, so that a restarted executive does not repeat an id that was spoken already.
  say("please-" + std::to_string(std::max<std::int64_t>(0, (now - memory_.item_began).count() / 1000000)),
      words_for_way(memory_.task, mood, count), mood);
  actions_.happenings.push_back(
      {EventKind::asked_for_way, memory_.task.order.exhibit_id, "", static_cast<double>(count)});
}

bool Executive::wants_contact() const {
  if (memory_.task.order.kind != TaskKind::charge) return false;
  if (docking_) return !docking_->move();
  return memory_.phase == Phase::done || (memory_.phase == Phase::running && !is_before_drive());
}

bool Executive::is_on_way_to_charger() const {
  const Directive* driven = under_way(DirectiveKind::drive);
  return memory_.task.order.kind == TaskKind::charge && driven != nullptr && driven->argument == "charger";
}

void Executive::stand_at_charger(Time now) {
  if (is_on_way_to_charger()) arrive(*under_way(DirectiveKind::drive), now);
}

void Executive::begin_docking(Time now) {
  const bool is_occupied = goal_.id == drive_order().id && goal_.is_occupied;
  const bool sees_tag = by_tag_ == ByTag::ready;
  const DockingStart start = drives_to_tag_ ? DockingStart::before_tag
                             : is_occupied  ? DockingStart::occupied
                             : sees_tag     ? DockingStart::at_charger_tag
                                            : DockingStart::at_charger;
  docking_.emplace(params_.docking, memory_.task.order.map_from_base, start, now);
  if (docking_->tag_order() || docking_->move()) send_drive();
}

void Executive::watch_docking(const Directive& directive, Time now) {
  const auto move = docking_->move();
  DockingView view{.contact = contact_, .by_tag = by_tag_};
  const bool is_by_tag = docking_->is_by_tag();
  if (goal_.id == drive_order().id) view.is_occupied = goal_.is_occupied;
  if (move && goal_.id == own_id(move->name)) {
    view.moved = goal_.state;
    view.blocked_s = goal_.blocked_s;
  }
  const auto state = docking_->step(view, now);
  if (state == Docking::State::docked) {
    stands_by_tag_ = is_by_tag;
    drives_to_tag_ = false;
    return end(directive, now);
  }
  if (state == Docking::State::failed) return fail_to_charge(docking_->failure());
  if (state == Docking::State::sets_out) send_drive();
  set_note(docking_->is_occupied() ? ReasonWord::charger_occupied : Reason{});
}

void Executive::fail_to_charge(ReasonWord why) {
  using interaction::Sentence;
  const Sentence call = why == ReasonWord::charger_occupied ? Sentence::free_charger : Sentence::mend_charger;
  if (why != ReasonWord::not_reached)
    say("call", interaction::sentence(call, memory_.task.order.language, Mood::sad, 0), Mood::sad);
  finish(false, why);
}

}  // namespace docent::task_control
