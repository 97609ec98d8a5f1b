#include "docent/task_control/golog_planner/golog_planner.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "docent/task_control/mission/mission.h"

namespace docent::task_control {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kStandsIn = "stand-in ";      // before the memory of a program that has failed
constexpr Duration kAskAgain = std::chrono::seconds{1};  // what may be visited: to compose a tour takes a while
// Of actions that begin and stop: more is a program that turns round in itself, at one moment or from one to the next.
constexpr int kMostActions = 50;
constexpr Duration kHurry = std::chrono::seconds{10};

std::string argument(const GologTerm& term) {
  if (term.arguments.empty()) return "";
  const auto* text = std::get_if<std::string>(&term.arguments.front());
  return text == nullptr ? "" : *text;
}

bool is_drive(const GologTerm& action) { return action.name == "drive"; }

Json to_json(const GologTerm& term) {
  Json arguments = Json::array();
  for (const auto& value : term.arguments) {
    std::visit([&](const auto& argument) { arguments.push_back(argument); }, value);
  }
  return {{"name", term.name}, {"arguments", arguments}};
}

GologTerm term_from(const Json& json) {
  GologTerm term{json.at("name").get<std::string>()};
  for (const Json& value : json.at("arguments")) {
    if (value.is_number()) {
      term.arguments.emplace_back(value.get<double>());
    } else {
      term.arguments.emplace_back(value.get<std::string>());
    }
  }
  return term;
}

}  // namespace

Result<void> GologPlannerParams::validate() const {
  if (auto valid = program.validate(); !valid) return valid;
  if (!(retry_s > 0.0)) return docent::fail("mission.golog.retry_s must be > 0");
  if (!(contact_s > 0.0)) return docent::fail("mission.golog.contact_s must be > 0");
  if (!(battery_step >= 0.0 && battery_step <= 1.0)) return docent::fail("mission.golog.battery_step must be in 0..1");
  return {};
}

void GologPlanner::decide(Mission& mission, Time now) {
  Situation seen = mission.situation(now);
  if (stands_in_ && !params_.has_stand_in) return;
  if (stands_in_) {
    if (now < retry_at_ || seen.activity != Activity::none || seen.has_visit || seen.has_tour || seen.has_farewell)
      return stand_in_.decide(mission, now);
    stands_in_ = false;
  }
  if (!seen.was_ever_localized) {  // it wakes up
    if (seen.is_settled) {
      mission.end_relocalizing(now);
    } else if (seen.is_lost && seen.activity != Activity::relocalize) {
      mission.relocalize();
    }
    if (!mission.situation(now).was_ever_localized) return;
  }
  if (seen.activity == Activity::farewell) return;
  watch(mission, seen, now);
  if (mission.situation(now).has_farewell && mission.situation(now).activity == Activity::none) {
    have_left_ = true;
    remember();
    return mission.say_farewell();
  }
  run(mission, now);
}

std::vector<GologTerm> GologPlanner::news(Mission& mission, const Situation& seen, Time now) {
  std::vector<GologTerm> events;
  const auto tell = [&](bool& told, bool is, const char* yes, const char* no) {
    if (std::exchange(told, is) != is) events.push_back({is ? yes : no, {}});
  };
  if (seen.is_localized || seen.is_lost) tell(known_.is_lost, !seen.is_localized, "lost", "localized");
  tell(known_.is_blocked, seen.is_blocked, "way_blocked", "way_free");
  tell(known_.is_closing, !seen.is_open, "closing", "opening");
  if (seen.charge && (!known_.charge || std::abs(*seen.charge - *known_.charge) >= params_.battery_step)) {
    known_.charge = seen.charge;
    events.push_back({"battery", {*seen.charge}});
  }
  const std::uint64_t revision = mission.scheduler().state().board.revision();
  if (seen.has_visit || (revision == known_.asked_revision && now < known_.ask_again)) return events;
  known_.asked_revision = revision;
  known_.ask_again = now + kAskAgain;
  const auto choices = mission.choices(now);
  const std::set<std::string> wanted{choices.begin(), choices.end()};
  for (const std::string& exhibit : known_.requested) {
    if (!wanted.contains(exhibit)) events.push_back({"cancelled", {exhibit}});
  }
  for (const std::string& exhibit : wanted) {
    if (!known_.requested.contains(exhibit)) events.push_back({"requested", {exhibit}});
  }
  known_.requested = wanted;
  return events;
}

void GologPlanner::watch(Mission& mission, const Situation& seen, Time now) {
  for (const UnderWay& action : std::vector<UnderWay>{under_way_}) {
    const double lasted_s = to_seconds(now - action.began);
    if (action.action.name == "relocalize" && seen.is_settled) {
      mission.end_relocalizing(now);
      end(action.action, {});
    } else if (action.action.name == "charge_battery") {
      if (seen.is_charged) {
        end(action.action, {});
      } else if (!seen.is_charging && lasted_s > params_.contact_s) {
        end(action.action, {GologOutcome::Kind::failed});
      }
    }
  }
}

void GologPlanner::run(Mission& mission, Time now) {
  const Known before = known_;
  auto events = news(mission, mission.situation(now), now);
  const bool opens =
      std::any_of(events.begin(), events.end(), [](const auto& event) { return event.name == "opening"; });
  if (opens && has_ended_) {
    if (const auto begun = program_.begin_again(); !begun) return fail(mission, begun.error(), now);
  }
  if (now - hurry_.since > kHurry) hurry_ = {now};
  while (++hurry_.actions <= kMostActions) {
    const auto step = program_.step(now, mission.position(), events);
    if (!step && !events.empty()) known_ = before;  // it has not heard of them
    if (!step) return fail(mission, step.error(), now);
    events.clear();
    has_ended_ = step->kind == GologStep::Kind::finished;
    if (const Situation seen = mission.situation(now); has_ended_ && seen.is_open && seen.is_anything_due)
      return fail(mission, Error{"the program has ended though the museum is open and somebody waits"}, now);
    if (step->kind == GologStep::Kind::begin) {
      begin(mission, step->action, now);
    } else if (step->kind == GologStep::Kind::stop) {
      stop(mission, step->action, now);
    } else {
      --hurry_.actions;
      remember();
      return;
    }
    if (stands_in_) return;
  }
  hurry_ = {now};
  fail(mission, Error{"the program begins one action after the other and comes to no end"}, now);
}

void GologPlanner::order(Mission& mission, const GologTerm& action, const std::string& kind, TaskOrder order,
                         Time now) {
  under_way_.push_back({action, now, kind});
  order.kind = Word<TaskKind>{std::string{kind}};
  if (order.language.empty()) order.language = mission.language();
  mission.order_action(std::move(order), now);
}

void GologPlanner::begin_drive(Mission& mission, const std::string& place, const GologTerm& action, Time now) {
  const Programme& programme = mission.scheduler().programme();
  const auto& visit = mission.scheduler().state().visit;
  // Where it explains nothing at the place to which it drove, its visitors wait again.
  if (visit && visit->exhibit_id != place && place != "charger") mission.stop(now);
  if (place == "home") return order(mission, action, "home", {"", {}, "", programme.home, "", false, ""}, now);
  if (place == "charger" && programme.charger) {
    // The visitors of the tour under way are told; the tour is given again from its beginning later.
    const Situation seen = mission.situation(now);
    if (seen.has_visit || seen.has_tour) mission.break_off_to_charge(now);
    return order(mission, action, "charge", mission.order_to_charge(), now);
  }
  const ProgrammeExhibit* exhibit = programme.find_exhibit(place);
  if (exhibit == nullptr) {
    under_way_.push_back({action, now, ""});
    return end(action, {GologOutcome::Kind::failed});
  }
  // Nobody may wait for it: a program may go where it likes.
  Pose2 pose = exhibit->pose;
  std::string tour;
  if (visit || mission.begin_visit_to(place, now)) {
    pose = visit->map_from_base;
    tour = visit->tour_id;
  }
  order(mission, action, "drive", {"", {}, place, pose, "", false, tour}, now);
}

/// The program need not drive, for it is there; the visit may want another viewpoint, and then the executive drives.
void GologPlanner::explain_where_asked(Mission& mission, const GologTerm& action, Time now) {
  have_left_ = false;
  const Visit& visit = *mission.scheduler().state().visit;
  const TaskOrder stop{"", {}, visit.exhibit_id, visit.map_from_base, visit.language, false, visit.tour_id};
  order(mission, action, to_text(TaskKind::visit), stop, now);
}

void GologPlanner::begin(Mission& mission, const GologTerm& action, Time now) {
  const std::string about = argument(action);
  if (action.name == "charge_battery") {  // the executive has nothing to do for it
    under_way_.push_back({action, now, ""});
    return;
  }
  const bool is_busy =
      std::any_of(under_way_.begin(), under_way_.end(), [](const UnderWay& other) { return !other.task_kind.empty(); });
  if (is_busy) {
    under_way_.push_back({action, now, ""});
    return end(action, {GologOutcome::Kind::failed});
  }
  if (is_drive(action)) return begin_drive(mission, about, action, now);
  if (action.name == "relocalize") {
    under_way_.push_back({action, now, action.name});
    mission.relocalize();
    return;
  }
  if (action.name == "explain" && !mission.situation(now).has_visit && mission.begin_visit_to(about, now))
    return explain_where_asked(mission, action, now);
  Pose2 here;
  here.x = mission.position().x;
  here.y = mission.position().y;
  const auto& visit = mission.scheduler().state().visit;
  if (action.name == "explain") have_left_ = false;
  const bool may_ask = action.name == "ask_more" && (!visit || visit->asks) && !have_left_;
  const std::string kind = action.name == "wait_for_request" ? to_text(TaskKind::mingle) : action.name;
  // Before it asks whether they want more it has explained: the visit is over, its visitors are still there.
  const bool goes_on = !visit && told_.exhibit == about;
  order(mission, action, kind,
        {"", {}, about, here, goes_on ? told_.language : "", may_ask, visit ? visit->tour_id : ""}, now);
}

void GologPlanner::stop(Mission& mission, const GologTerm& action, Time now) {
  const auto stopped =
      std::find_if(under_way_.begin(), under_way_.end(), [&](const UnderWay& other) { return other.action == action; });
  if (stopped == under_way_.end()) return;
  const bool has_task = !stopped->task_kind.empty();
  under_way_.erase(stopped);
  if (has_task) mission.stop(now);
}

void GologPlanner::outcome(Mission& mission, const TaskOrder& order, const ActionOutcome& outcome, Time now) {
  const auto done = std::find_if(under_way_.begin(), under_way_.end(), [&](const UnderWay& other) {
    return !other.task_kind.empty() && order.kind.text() == other.task_kind;
  });
  if (done == under_way_.end()) return;
  const GologTerm action = done->action;
  const auto& visit = mission.scheduler().state().visit;
  const bool is_of_visit = visit && visit->exhibit_id == argument(action);
  // The program takes it for served: should it still be wanted, it is told anew.
  if (action.name == "explain") known_.requested.erase(argument(action));
  if (is_of_visit) told_ = {visit->exhibit_id, visit->language};
  if (is_of_visit && (action.name == "explain" || (is_drive(action) && !outcome.is_done))) {
    mission.finish_visit(outcome.is_done, outcome.reason, now);
  }
  if (!outcome.is_done) {
    end(action, {GologOutcome::Kind::failed});
  } else if (action.name == "ask_more") {
    end(action, {GologOutcome::Kind::sensed, outcome.took_long ? "more" : "next"});
  } else {
    end(action, {});
  }
}

void GologPlanner::end(const GologTerm& action, GologOutcome outcome) {
  std::erase_if(under_way_, [&](const UnderWay& other) { return other.action == action; });
  if (const auto told = program_.outcome(action, outcome); !told) fault_ = told.error().message;
}

void GologPlanner::fail(Mission& mission, const Error& error, Time now) {
  mission.stop(now);  // the stand-in has its own ways, and begins anew
  fault_ = error.message;
  stands_in_ = true;
  retry_at_ = now + seconds(params_.retry_s);
  if (program_.is_alive()) {
    for (const UnderWay& action : std::vector<UnderWay>{under_way_}) end(action.action, {GologOutcome::Kind::failed});
  } else {  // it begins anew, and knows nothing
    under_way_.clear();
    known_ = {};
    has_ended_ = false;
  }
  fault_ = error.message;
}

void GologPlanner::remember() {
  fault_.clear();
  const auto snapshot = program_.snapshot();
  if (!snapshot) {
    fault_ = snapshot.error().message;
    return;
  }
  Json under_way = Json::array();
  for (const UnderWay& action : under_way_) {
    under_way.push_back(
        {{"action", to_json(action.action)}, {"began", action.began.nanoseconds}, {"task", action.task_kind}});
  }
  memory_ = Json{{"snapshot", *snapshot},    {"requested", known_.requested}, {"under_way", under_way},
                 {"lost", known_.is_lost},   {"blocked", known_.is_blocked},  {"closing", known_.is_closing},
                 {"exhibit", told_.exhibit}, {"language", told_.language},    {"left", have_left_},
                 {"ended", has_ended_}}
                .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string GologPlanner::memory() const { return (stands_in_ ? std::string{kStandsIn} : "") + memory_; }

bool GologPlanner::restore(const std::string& memory, TaskOrder& task) {
  if (memory.starts_with(kStandsIn)) {  // what is under way was ordered by the plan controller, and goes on as it does
    TaskOrder none;
    static_cast<void>(restore(memory.substr(kStandsIn.size()), none));
    for (const UnderWay& action : std::vector<UnderWay>{under_way_}) end(action.action, {GologOutcome::Kind::failed});
    fault_ = "the program has failed and is tried again";
    stands_in_ = true;
    return false;
  }
  if (memory.empty()) {
    task = {};
    return true;
  }
  try {
    const Json json = Json::parse(memory);
    if (const auto restored = program_.restore(json.at("snapshot").get<std::string>()); !restored) {
      fault_ = restored.error().message;  // the program was changed: it begins anew
      task = {};
      return true;
    }
    known_.requested = json.at("requested").get<std::set<std::string>>();
    for (const Json& action : json.at("under_way")) {
      under_way_.push_back({term_from(action.at("action")),
                            {action.at("began").get<std::int64_t>()},
                            action.at("task").get<std::string>()});
    }
    known_.is_lost = json.at("lost").get<bool>();
    known_.is_blocked = json.at("blocked").get<bool>();
    known_.is_closing = json.at("closing").get<bool>();
    told_ = {json.value("exhibit", ""), json.value("language", "")};
    have_left_ = json.value("left", false);
    has_ended_ = json.value("ended", false);
    memory_ = memory;
  } catch (const Json::exception& why) {
    fault_ = std::string{"what the planner remembered is damaged: "} + why.what();
    task = {};
  }
  return true;
}

}  // namespace docent::task_control
