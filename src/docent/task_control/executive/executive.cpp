#include "docent/task_control/executive/executive.h"

#include <algorithm>
#include <array>

#include "docent/interaction/speech/sentences.h"
#include "docent/interaction/speech/spoken_text.h"

namespace docent::task_control {
namespace {

constexpr std::array<const char*, 9> kSteps{
    "idle", "driving", "relocalizing", "explaining", "asking", "explaining_more", "waiting", "done", "failed"};

constexpr double kChargerTolerance = 0.15;                   ///< [m] contacts lie closer than where an exhibit is shown
constexpr Duration kObstacleLife = std::chrono::seconds{1};  // the collision avoidance speaks four times a second

bool is_positive(double value) { return value > 0.0; }

/// As which state of the task a step is told; nullopt: there is no task.
std::optional<TaskStatus> status_of(Step step) {
  switch (step) {
    case Step::idle:
      return std::nullopt;
    case Step::driving:
    case Step::relocalizing:
      return TaskStatus::driving;
    case Step::explaining:
    case Step::explaining_more:
    case Step::waiting:
      return TaskStatus::explaining;
    case Step::asking:
      return TaskStatus::asking;
    case Step::done:
      return TaskStatus::done;
    case Step::failed:
      return TaskStatus::failed;
  }
  return std::nullopt;
}

}  // namespace

const char* to_text(Step step) { return kSteps[static_cast<std::size_t>(step)]; }

std::optional<Step> step_of(const std::string& text) {
  for (std::size_t i = 0; i < kSteps.size(); ++i) {
    if (text == kSteps[i]) return static_cast<Step>(i);
  }
  return std::nullopt;
}

Result<void> ExecutiveParams::validate() const {
  if (auto valid = ladder.validate(); !valid) return fail("executive." + valid.error().message);
  if (!is_positive(max_drive_s)) return fail("executive.max_drive_s must be > 0");
  if (!is_positive(offer_s)) return fail("executive.offer_s must be > 0");
  if (!is_positive(resend_s)) return fail("executive.resend_s must be > 0");
  if (!is_positive(checkpoint_age_s)) return fail("executive.checkpoint_age_s must be > 0");
  return {};
}

Executive::Executive(const ExecutiveParams& params, ExecutiveMemory memory, Time now)
    : params_{params}, memory_{std::move(memory)}, ladder_{params.ladder} {
  resume(now);
}

void Executive::resume(Time now) {
  // A clock that went back belongs to another life.
  memory_.step_began = std::min(memory_.step_began, now);
  memory_.drive_began = std::min(memory_.drive_began, now);
  if (is_speaking() || memory_.step == Step::asking) {
    if (now - memory_.step_began > seconds(params_.checkpoint_age_s)) {
      if (memory_.task.order.kind == TaskKind::farewell) return finish(true, "", now);  // the visitors are gone
      enter(Step::driving, now);
      return;
    }
  }
  send_drive();
  report();
}

void Executive::set_task(ExecutiveTask task, Time now) {
  if (task.order.id == memory_.task.order.id) return;
  memory_ = {};
  memory_.task = std::move(task);
  goal_ = {};
  const TaskOrder& order = memory_.task.order;
  if (order.id.empty()) {
    enter(Step::idle, now);
  } else if (order.kind == TaskKind::visit || order.kind == TaskKind::home || order.kind == TaskKind::charge) {
    if (order.kind == TaskKind::visit) {
      say("announcement",
          interaction::sentence(interaction::Sentence::announcement, order.language, memory_.task.title), Mood::happy);
    }
    if (order.kind == TaskKind::charge && !(order.exhibit_id.empty() && order.tour_id.empty())) {
      say("announcement", interaction::sentence(interaction::Sentence::must_charge, order.language), Mood::sad);
    }
    memory_.drive_began = now;
    enter(Step::driving, now);
  } else if (order.kind == TaskKind::farewell) {
    enter(Step::explaining, now);
  } else if (order.kind == TaskKind::relocalize) {
    enter(Step::relocalizing, now);
  } else {
    finish(false, "I do not know the task '" + order.kind.text() + "'.", now);
  }
}

std::string Executive::own_id(const std::string& name) const { return memory_.task.order.id + "/" + name; }

bool Executive::is_speaking() const {
  return memory_.step == Step::explaining || memory_.step == Step::explaining_more;
}

void Executive::enter(Step step, Time now) {
  memory_.step = step;
  memory_.step_began = now;
  ladder_.restart();
  heard_.reset();
  speech_sent_.reset();
  note_.clear();
  actions_.must_save = true;
  if (step == Step::idle || step == Step::driving || step == Step::relocalizing || step == Step::failed) send_drive();
  if (is_speaking()) send_speech(now);
  if (step == Step::asking) {
    say("question", question().text, Mood::neutral);
    actions_.happenings.push_back(
        {EventKind::prompt_shown, memory_.task.order.exhibit_id, question().id, params_.offer_s});
  }
  report();
}

void Executive::finish(bool is_success, const std::string& reason, Time now) {
  memory_.reason = reason;
  enter(is_success ? Step::done : Step::failed, now);
}

void Executive::send_drive() {
  const TaskOrder& order = memory_.task.order;
  switch (memory_.step) {
    case Step::idle:
    case Step::failed:
      actions_.drive = DriveOrder{};
      break;
    case Step::relocalizing:
      actions_.drive = DriveOrder{own_id("relocalize"), {}, true};
      break;
    default:  // the heading of the place is the one that faces the exhibit
      if (order.kind == TaskKind::relocalize) {
        actions_.drive = DriveOrder{};
      } else {
        actions_.drive = DriveOrder{own_id("drive"), order.map_from_base};
        if (order.kind == TaskKind::charge) actions_.drive->position_tolerance = kChargerTolerance;
      }
      break;
  }
}

void Executive::say(const std::string& name, const std::string& text, Mood mood) {
  actions_.utterances.push_back({own_id(name), text, memory_.task.order.language, mood});
}

Utterance Executive::speech() const {
  const TaskOrder& order = memory_.task.order;
  if (order.kind == TaskKind::farewell) {
    return {own_id("farewell"), interaction::sentence(interaction::Sentence::farewell, order.language), order.language,
            Mood::happy};
  }
  const bool is_long = memory_.step == Step::explaining_more;
  const std::string text =
      is_long ? memory_.task.long_text : interaction::spoken_text(memory_.task.title) + " " + memory_.task.short_text;
  return {own_id(is_long ? "long" : "short"), text, memory_.task.order.language, Mood::neutral};
}

void Executive::send_speech(Time now) {
  actions_.utterances.push_back(speech());
  speech_sent_ = now;
}

Time Executive::question_deadline() const { return memory_.step_began + seconds(params_.offer_s); }

Question Executive::question() const {
  if (memory_.step != Step::asking) return {};
  return {own_id("more"),
          interaction::sentence(interaction::Sentence::offer_more, memory_.task.order.language, memory_.task.title),
          {Answer::more, Answer::next},
          Answer::next,
          question_deadline()};
}

void Executive::report() {
  if (memory_.step == Step::idle) {
    actions_.report = TaskReport{};
    return;
  }
  TaskReport report{task_id(), status_of(memory_.step), memory_.reason, question(), memory_.took_long};
  if (!note_.empty()) report.reason = note_;
  actions_.report = std::move(report);
}

void Executive::set_note(const std::string& note) {
  if (note == note_) return;
  note_ = note;
  report();
}

void Executive::goal_report(const GoalReport& goal, Time now) {
  goal_ = goal;
  if (memory_.step == Step::relocalizing) {
    if (goal.id != own_id("relocalize")) return;
    if (goal.state == GoalStatus::arrived) {
      finish(true, "", now);
    } else {
      climb_ladder(now);
    }
    return;
  }
  if (memory_.step != Step::driving || goal.id != own_id("drive")) return;
  if (goal.state == GoalStatus::arrived) {
    arrive(now);
    return;
  }
  const bool is_stuck = goal.state == GoalStatus::blocked || goal.state == GoalStatus::unreachable;
  if (goal.state == GoalStatus::driving || goal.state == GoalStatus::turning) {
    set_note("");
  } else if (is_stuck && note_.empty()) {
    set_note(goal.state == GoalStatus::unreachable ? "I see no way there." : "Someone is in my way.");
    actions_.happenings.push_back({EventKind::drive_blocked, memory_.task.order.exhibit_id,
                                   std::string{to_text(goal.state)} + " " + goal.reason, goal.remaining_m});
  }
  watch_drive(now);
}

void Executive::arrive(Time now) {
  const TaskOrder& order = memory_.task.order;
  actions_.happenings.push_back({EventKind::arrived,
                                 order.kind == TaskKind::visit ? order.exhibit_id : order.kind.text(), order.id,
                                 to_seconds(now - memory_.drive_began)});
  if (order.kind == TaskKind::visit) {
    enter(Step::explaining, now);
    return;
  }
  // At a charger that gives no current it tries again and again without going anywhere: it greets once.
  constexpr double kNoDrive = 5.0;  // [s]
  const bool stood_there = order.kind == TaskKind::charge && now - memory_.drive_began < seconds(kNoDrive);
  const interaction::Sentence greeting =
      order.kind == TaskKind::charge ? interaction::Sentence::at_charger : interaction::Sentence::home_again;
  if (!stood_there) say(order.kind.text(), interaction::sentence(greeting, order.language), Mood::happy);
  finish(true, "", now);
}

void Executive::watch_drive(Time now) {
  if (now - memory_.drive_began > seconds(params_.max_drive_s)) {
    finish(false, "It took me too long to get there.", now);
  } else if (goal_.id == own_id("drive")) {
    climb_ladder(now);
  }
}

void Executive::obstacle_report(const ObstacleReport& report, Time now) {
  obstacle_ = report;
  obstacle_time_ = now;
}

void Executive::climb_ladder(Time now) {
  if (now - obstacle_time_ > kObstacleLife) obstacle_ = {};
  const bool is_unreachable = goal_.state == GoalStatus::unreachable;
  const LadderView view{obstacle_.is_hindered,
                        obstacle_.is_unmapped,
                        is_unreachable,
                        goal_.blocked_s,
                        planning::detour_of(goal_.detour),
                        obstacle_.reason.empty() ? goal_.reason : obstacle_.reason,
                        obstacle_.is_thing};
  auto steps = ladder_.step(view, now);
  bool gives_up = false;
  for (const LadderStep& step : steps) {
    if (step.rung == Rung::ask) ask_for_way(now, step.count);
    gives_up = gives_up || step.rung == Rung::give_up;
  }
  actions_.reactions_of = goal_.id;
  actions_.reactions.insert(actions_.reactions.end(), steps.begin(), steps.end());
  // Who does not know where they are choose nothing else.
  if (gives_up && memory_.step == Step::driving)
    finish(false, is_unreachable ? "I found no way there." : "The way was blocked for too long.", now);
}

void Executive::ask_for_way(Time now, int count) {
  // The name carries the time, so that a restarted executive does not repeat an id that was spoken already.
  say("please-" + std::to_string(std::max<std::int64_t>(0, (now - memory_.step_began).count() / 1000000)),
      interaction::sentence(interaction::Sentence::let_me_through, memory_.task.order.language),
      count == 1 ? Mood::neutral : Mood::sad);
  actions_.happenings.push_back(
      {EventKind::asked_for_way, memory_.task.order.exhibit_id, "", static_cast<double>(count)});
}

void Executive::speech_report(const SpeechReport& report, Time now) {
  if (!is_speaking() || report.id != speech().id) return;
  heard_ = report;
  watch_speech(now);
}

void Executive::watch_speech(Time now) {
  const Utterance present = speech();
  bool is_over = false;
  if (heard_) {
    is_over = heard_->state != SpeechStatus::speaking || now > heard_->start + seconds(heard_->duration_s + 5.0);
  } else {
    const double foreseen_s = interaction::speech_duration(present.text, present.language, present.mood);
    is_over = now > memory_.step_began + seconds(1.5 * foreseen_s + 5.0);
    if (!is_over && (!speech_sent_ || now - *speech_sent_ >= seconds(params_.resend_s))) send_speech(now);
  }
  if (!is_over) return;
  const bool has_more = !memory_.task.long_text.empty() && memory_.task.order.offer_more;
  if (memory_.step == Step::explaining && has_more) {
    enter(Step::asking, now);
  } else {
    end_visit(now);
  }
}

void Executive::end_visit(Time now) {
  if (memory_.task.wait_s > 0.0) {
    enter(Step::waiting, now);
  } else {
    finish(true, "", now);
  }
}

void Executive::choose(const std::string& question_id, std::optional<Answer> option, Time now) {
  if (memory_.step != Step::asking || question_id != own_id("more")) return;
  if (option != Answer::more && option != Answer::next) return;
  actions_.happenings.push_back({EventKind::choice, memory_.task.order.exhibit_id, to_text(option)});
  if (option == Answer::more) {
    memory_.took_long = true;
    enter(Step::explaining_more, now);
  } else {
    end_visit(now);
  }
}

void Executive::tick(Time now) {
  if (memory_.step == Step::driving) {
    watch_drive(now);
  } else if (is_speaking()) {
    watch_speech(now);
  } else if (memory_.step == Step::asking && now >= question_deadline()) {
    actions_.happenings.push_back({EventKind::choice, memory_.task.order.exhibit_id, "next (default)"});
    end_visit(now);
  } else if (memory_.step == Step::waiting && now - memory_.step_began >= seconds(memory_.task.wait_s)) {
    finish(true, "", now);
  }
}

}  // namespace docent::task_control
