#include "docent/task_control/golex/executive.h"

#include <algorithm>
#include <cstdlib>

#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/speech/spoken_text.h"
#include "docent/task_control/golex/directive_text.h"

namespace docent::task_control {
namespace {

template <class T>
bool contains(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

Executive::Executive(const ExecutiveParams& params, Decomposition decomposition, ExecutiveMemory memory, Time now)
    : params_{params}, decomposition_{std::move(decomposition)}, memory_{std::move(memory)}, ladder_{params.ladder} {
  resume(now);
}

void Executive::resume(Time now) {
  approach_ = ApproachWatch{params_.approach, now};
  // A clock that went back belongs to another life.
  memory_.item_began = std::min(memory_.item_began, now);
  memory_.drive_began = std::min(memory_.drive_began, now);
  if (memory_.phase == Phase::running) {
    const auto* action = decomposition_.find(memory_.task.order.kind.text());
    const bool is_other = action == nullptr || memory_.item < 0 || memory_.item >= static_cast<int>(action->size());
    const bool is_old = drive_under_way() == nullptr && now - memory_.item_began > seconds(params_.checkpoint_age_s);
    if (is_old && !has_drive()) {  // those to whom it spoke are gone; an exhibit was not explained
      const bool is_owed = !memory_.task.order.exhibit_id.empty();
      return finish(!is_owed, is_owed ? Reason{ReasonWord::took_too_long} : Reason{});
    }
    if (action == nullptr) return finish(false, {ReasonWord::unknown_task, memory_.task.order.kind.text()});
    if (is_other || is_old) {  // the file was changed, or visitors and place are others by now
      begin_item(0, now);
      return;
    }
  }
  if (under_way(DirectiveKind::dock) != nullptr) begin_docking(now);
  send_drive();
  report();
}

void Executive::set_task(ExecutiveTask task, Time now) {
  if (task.order.id == memory_.task.order.id) return;
  const std::string last_tour = memory_.tour;
  if (under_way(DirectiveKind::drive) != nullptr) approach_.interrupt(now);
  memory_ = {};
  memory_.task = std::move(task);
  memory_.tour = tour_after(memory_.task.order, has_drive(), last_tour);
  memory_.tour_begins = !memory_.tour.empty() && memory_.tour != last_tour;
  memory_.drive_began = now;
  goal_ = {};
  docking_.reset();
  stands_by_tag_ = false;
  actions_.must_save = true;
  const TaskOrder& order = memory_.task.order;
  send_drive();  // what it did before is over, whatever begins now
  if (order.id.empty()) {
    actions_.music = false;
    report();
  } else if (decomposition_.find(order.kind.text()) != nullptr) {
    memory_.phase = Phase::running;
    begin_item(0, now);
  } else {
    finish(false, {ReasonWord::unknown_task, order.kind.text()});
  }
}

std::string Executive::own_id(const std::string& name) const { return memory_.task.order.id + "/" + name; }

const std::vector<Directive>& Executive::together() const {
  static const std::vector<Directive> kNone;
  if (memory_.phase != Phase::running) return kNone;
  const auto* action = decomposition_.find(memory_.task.order.kind.text());
  if (action == nullptr || memory_.item < 0 || memory_.item >= static_cast<int>(action->size())) return kNone;
  return (*action)[static_cast<std::size_t>(memory_.item)].together;
}

Mood Executive::mood() const {
  if (together().empty()) return Mood::neutral;
  if (memory_.task.style) return memory_.task.style->face;
  return (*decomposition_.find(memory_.task.order.kind.text()))[static_cast<std::size_t>(memory_.item)].mood;
}

const Directive* Executive::under_way(DirectiveKind kind) const {
  for (const Directive& directive : together()) {
    if (directive.kind == kind && holds_up(kind) && !contains(memory_.finished, directive.name)) return &directive;
  }
  return nullptr;
}

bool Executive::leads_from(int first) const {
  const auto* action = decomposition_.find(memory_.task.order.kind.text());
  return action != nullptr && leads_somewhere(*action, static_cast<std::size_t>(first));
}

const Directive* Executive::drive_under_way() const {
  const Directive* drive = under_way(DirectiveKind::drive);
  return drive != nullptr ? drive : under_way(DirectiveKind::relocalize);
}

bool Executive::holds(Condition condition) const {
  const TaskOrder& order = memory_.task.order;
  switch (condition) {
    case Condition::always:
      return true;
    case Condition::more:
      return memory_.took_long;
    case Condition::broken_off:
      return order.kind == TaskKind::charge && !(order.exhibit_id.empty() && order.tour_id.empty());
    case Condition::moved:
      return memory_.moved;
    case Condition::tour_begins:
      return memory_.tour_begins;
  }
  return true;
}

void Executive::begin_item(int item, Time now) {
  const std::vector<ActionItem>& items = *decomposition_.find(memory_.task.order.kind.text());
  while (item < static_cast<int>(items.size()) && !holds(items[static_cast<std::size_t>(item)].condition)) ++item;
  if (item >= static_cast<int>(items.size())) {
    finish(true, {});
    return;
  }
  memory_.item = item;
  memory_.item_began = now;
  memory_.finished.clear();
  ladder_.restart();
  heard_.reset();
  speech_sent_.reset();
  note_ = {};
  docking_.reset();
  actions_.must_save = true;
  for (const Directive& directive : together()) begin(directive, now);
  const bool is_over = std::none_of(together().begin(), together().end(),
                                    [&](const Directive& directive) { return under_way(directive.kind) != nullptr; });
  if (is_over) {
    begin_item(item + 1, now);
  } else {
    report();
  }
}

void Executive::begin(const Directive& directive, Time now) {
  switch (directive.kind) {
    case DirectiveKind::look:
      memory_.look = directive.argument;
      break;
    case DirectiveKind::horn:
      actions_.horns.push_back(directive.argument);
      break;
    case DirectiveKind::music:
      actions_.music = directive.argument == "play";
      break;
    case DirectiveKind::announce:
      if (const std::string text = text_of(directive, memory_.task, mood()); !text.empty())
        say(directive.name, text, mood());
      break;
    case DirectiveKind::drive:
      memory_.drive_began = now;
      approach_.set_out(memory_.task.order.map_from_base, now);
      drives_to_tag_ = directive.argument == "charger" && by_tag_ == ByTag::ready;
      [[fallthrough]];
    case DirectiveKind::relocalize:
      send_drive();
      break;
    case DirectiveKind::dock:
      begin_docking(now);
      break;
    case DirectiveKind::say:
      if (text_of(directive, memory_.task, mood()).empty()) {
        memory_.finished.push_back(directive.name);
      } else {
        send_speech(directive, now);
      }
      break;
    case DirectiveKind::ask:
      if (!is_asked()) {
        memory_.finished.push_back(directive.name);
        break;
      }
      say("question",
          interaction::sentence(question().sentence, question().language, Mood::neutral, question().variant),
          Mood::neutral);
      actions_.happenings.push_back(
          {EventKind::prompt_shown, memory_.task.order.exhibit_id, question().id, params_.offer_s});
      break;
    case DirectiveKind::wait:
      if (!(wait_s(directive) > 0.0)) memory_.finished.push_back(directive.name);
      break;
  }
}

void Executive::end(const Directive& directive, Time now) {
  memory_.finished.push_back(directive.name);
  actions_.must_save = true;
  const bool is_over = std::all_of(together().begin(), together().end(), [&](const Directive& other) {
    return !holds_up(other.kind) || contains(memory_.finished, other.name);
  });
  if (is_over) {
    begin_item(memory_.item + 1, now);
  } else {
    report();
  }
}

void Executive::finish(bool is_success, const Reason& reason) {
  memory_.phase = is_success ? Phase::done : Phase::failed;
  memory_.reason = reason;
  note_ = {};
  actions_.must_save = true;
  if (!is_success) {
    send_drive();
    actions_.music = false;
  }
  report();
}

void Executive::say(const std::string& name, const std::string& text, Mood mood) {
  actions_.utterances.push_back({own_id(name), text, memory_.task.order.language, mood});
}

void Executive::send_speech(const Directive& directive, Time now) {
  say(directive.name, text_of(directive, memory_.task, mood()), mood());
  speech_sent_ = now;
}

double Executive::wait_s(const Directive& directive) const {
  return directive.argument == "linger" ? memory_.task.wait_s : std::strtod(directive.argument.c_str(), nullptr);
}

Time Executive::question_deadline() const { return memory_.item_began + seconds(params_.offer_s); }

Question Executive::question() const {
  const Directive* asked = under_way(DirectiveKind::ask);
  if (asked == nullptr) return {};
  return {own_id(asked->name),          interaction::Sentence::offer_more,
          memory_.task.order.language,  variant_of(*asked, memory_.task),
          {Answer::more, Answer::next}, Answer::next,
          question_deadline()};
}

std::optional<TaskStatus> Executive::status() const {
  switch (memory_.phase) {
    case Phase::idle:
      return std::nullopt;
    case Phase::done:
      return TaskStatus::done;
    case Phase::failed:
      return TaskStatus::failed;
    case Phase::running:
      break;
  }
  if (under_way(DirectiveKind::ask) != nullptr) return TaskStatus::asking;
  return is_before_drive() || docking_ ? TaskStatus::driving : TaskStatus::explaining;
}

void Executive::report() {
  if (memory_.phase == Phase::idle) {
    actions_.report = TaskReport{};
    return;
  }
  TaskReport report{task_id(), status(), memory_.reason, question(), memory_.took_long, memory_.look};
  if (!note_.is_none()) report.reason = note_;
  actions_.report = std::move(report);
}

void Executive::set_note(const Reason& note) {
  if (note == note_) return;
  note_ = note;
  report();
}

void Executive::goal_report(const GoalReport& goal, Time now) {
  goal_ = goal;
  if (const Directive* docks = under_way(DirectiveKind::dock)) {
    watch_docking(*docks, now);
    return;
  }
  const Directive* driven = drive_under_way();
  if (driven == nullptr || goal.id != own_id(driven->name)) return;
  if (goal.state == GoalStatus::arrived) {
    arrive(*driven, now);
    return;
  }
  if (driven->kind == DirectiveKind::relocalize) {
    climb_ladder(now);
    return;
  }
  const bool is_stuck = goal.state == GoalStatus::blocked || goal.state == GoalStatus::unreachable;
  approach_.see(goal.state, goal.remaining_m, now);
  if (goal.state == GoalStatus::driving || goal.state == GoalStatus::turning) {
    set_note({});
  } else if (is_stuck && note_.is_none()) {
    set_note(goal.state == GoalStatus::unreachable ? ReasonWord::no_way : ReasonWord::person_in_way);
    actions_.happenings.push_back({EventKind::drive_blocked, memory_.task.order.exhibit_id,
                                   std::string{to_text(goal.state)} + " " + goal.reason, goal.remaining_m});
  }
  watch_drive(now);
}

void Executive::arrive(const Directive& directive, Time now) {
  if (directive.kind == DirectiveKind::drive) {
    const TaskOrder& order = memory_.task.order;
    const Duration lasted = now - memory_.drive_began;
    memory_.moved = lasted >= seconds(params_.no_drive_s);
    const bool is_rest = order.kind == TaskKind::home || order.kind == TaskKind::charge;
    actions_.happenings.push_back(
        {EventKind::arrived, is_rest ? order.kind.text() : order.exhibit_id, order.id, to_seconds(lasted)});
  }
  note_ = {};
  end(directive, now);
}

void Executive::speech_report(const SpeechReport& report, Time now) {
  const Directive* spoken = under_way(DirectiveKind::say);
  if (spoken == nullptr || report.id != own_id(spoken->name)) return;
  heard_ = report;
  watch_speech(*spoken, now);
}

void Executive::watch_speech(const Directive& directive, Time now) {
  bool is_over = false;
  if (heard_) {
    is_over = heard_->state != SpeechStatus::speaking || now > heard_->start + seconds(heard_->duration_s + 5.0);
  } else {
    const double foreseen_s =
        interaction::speech_duration(text_of(directive, memory_.task, mood()), memory_.task.order.language, mood());
    is_over = now > memory_.item_began + seconds(1.5 * foreseen_s + 5.0);
    if (!is_over && (!speech_sent_ || now - *speech_sent_ >= seconds(params_.resend_s))) send_speech(directive, now);
  }
  if (is_over) end(directive, now);
}

void Executive::watch_wait(const Directive& directive, Time now) {
  if (now - memory_.item_began >= seconds(wait_s(directive))) end(directive, now);
}

void Executive::choose(const std::string& question_id, std::optional<Answer> option, Time now) {
  const Directive* asked = under_way(DirectiveKind::ask);
  if (asked == nullptr || question_id != own_id(asked->name)) return;
  if (option != Answer::more && option != Answer::next) return;
  actions_.happenings.push_back({EventKind::choice, memory_.task.order.exhibit_id, to_text(option)});
  memory_.took_long = memory_.took_long || option == Answer::more;
  end(*asked, now);
}

void Executive::tick(Time now) {
  // Each may end the item: what comes next is looked up anew.
  watch_drive(now);
  if (const Directive* docks = under_way(DirectiveKind::dock)) watch_docking(*docks, now);
  if (const Directive* spoken = under_way(DirectiveKind::say)) watch_speech(*spoken, now);
  if (const Directive* asked = under_way(DirectiveKind::ask); asked != nullptr && now >= question_deadline()) {
    actions_.happenings.push_back({EventKind::choice, memory_.task.order.exhibit_id, "next (default)"});
    end(*asked, now);
  }
  if (const Directive* waited = under_way(DirectiveKind::wait)) watch_wait(*waited, now);
}

}  // namespace docent::task_control
