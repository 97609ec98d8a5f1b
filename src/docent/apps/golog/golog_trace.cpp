#include "docent/apps/golog/golog_trace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <sstream>

namespace docent::apps::golog_command {
namespace {

using task_control::GologOutcome;
using task_control::GologStep;
using task_control::GologTerm;

constexpr double kTick = 1.0;       // [s] between two steps at most, as the robot makes them
constexpr double kPatience = 60.0;  // [s] of waiting after the last event
constexpr int kMostSteps = 1000;    // of one moment: a program that begins more will never wait

std::string at(const std::filesystem::path& file, int line, const std::string& what) {
  return file.string() + ":" + std::to_string(line) + ": " + what;
}

std::optional<double> number_of(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<TraceEvent> event_of(std::vector<std::string> words) {
  const auto time = number_of(words.front());
  if (!time || *time < 0.0) return fail("a line begins with its time in seconds, not with '" + words.front() + "'");
  TraceEvent event{*time, TraceEvent::Kind::event, {}};
  words.erase(words.begin());
  if (!words.empty() && (words.front() == "failed" || words.front() == "sensed")) {
    event.kind = words.front() == "failed" ? TraceEvent::Kind::failed : TraceEvent::Kind::sensed;
    words.erase(words.begin());
  }
  if (event.kind == TraceEvent::Kind::sensed) {
    if (words.size() < 2) return fail("'sensed' needs an action and a value");
    event.value = words.back();
    words.pop_back();
  }
  if (words.empty()) return fail("nothing happens on this line");
  event.term.name = words.front();
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (const auto number = number_of(words[i])) {
      event.term.arguments.emplace_back(*number);
    } else {
      event.term.arguments.emplace_back(words[i]);
    }
  }
  return event;
}

struct RunningAction {
  GologTerm action;
  double ends_s = 0.0;
};

/// A robot that does what the program says.
class Player {
 public:
  Player(task_control::GologProgram& program, const task_control::Programme& programme,
         const std::function<void(const std::string&)>& print)
      : program_{program}, programme_{programme}, print_{print}, robot_{programme.home.x, programme.home.y} {}

  [[nodiscard]] bool is_finished() const { return is_finished_; }
  [[nodiscard]] bool is_busy() const { return !running_.empty(); }
  [[nodiscard]] double next_end_s() const {
    double next = std::numeric_limits<double>::infinity();
    for (const RunningAction& running : running_) next = std::min(next, running.ends_s);
    return next;
  }

  /// Ends what is done by now, and then steps until the program waits.
  Result<void> go_on(double now_s, std::vector<GologTerm> events) {
    for (std::size_t i = 0; i < running_.size();) {
      if (running_[i].ends_s > now_s) {
        ++i;
        continue;
      }
      if (auto ended = end(now_s, running_[i].action, {}); !ended) return ended;
    }
    for (int count = 0; count < kMostSteps; ++count) {
      auto step = program_.step(time_from_seconds(now_s), robot_, events);
      if (!step) return tl::unexpected(step.error());
      for (const GologTerm& event : events) say(now_s, "event", to_text(event));
      events.clear();
      if (step->kind == GologStep::Kind::waits) return {};
      if (step->kind == GologStep::Kind::finished) {
        is_finished_ = true;
        say(now_s, "finished");
        return {};
      }
      if (step->kind == GologStep::Kind::begin) {
        running_.push_back({step->action, now_s + program_.expected_s(robot_, step->action).value_or(kTick)});
      } else {
        forget(step->action);
      }
      say(now_s, step->kind == GologStep::Kind::begin ? "begin" : "stop", to_text(step->action));
    }
    return fail("the program does not come to rest: " + std::to_string(kMostSteps) + " steps at one moment");
  }

  /// Says why nothing more comes of the program.
  Result<void> say_waits(double now_s) {
    const auto impossible = program_.impossible();
    if (!impossible) return tl::unexpected(impossible.error());
    if (impossible->empty()) say(now_s, "waits");
    for (const GologTerm& action : *impossible) say(now_s, "waits", "for " + to_text(action) + ", which is impossible");
    return {};
  }
  void say_is_up(double now_s) { say(now_s, "the time is up"); }

  /// False: it is not under way.
  [[nodiscard]] bool is_running(const GologTerm& action) const {
    return std::any_of(running_.begin(), running_.end(),
                       [&](const RunningAction& one) { return one.action == action; });
  }

  Result<void> end(double now_s, const GologTerm action, const GologOutcome& outcome) {  // a copy: it is forgotten here
    forget(action);
    if (outcome.kind != GologOutcome::Kind::failed && action.name == "drive") arrive(action);
    const char* words[]{"done", "sensed", "failed"};
    say(now_s, words[static_cast<int>(outcome.kind)],
        to_text(action) + (outcome.value.empty() ? "" : " = " + outcome.value));
    return program_.outcome(action, outcome);
  }

 private:
  void arrive(const GologTerm& action) {
    const auto* place = action.arguments.empty() ? nullptr : std::get_if<std::string>(&action.arguments.front());
    if (place == nullptr) return;
    if (*place == "home") robot_ = {programme_.home.x, programme_.home.y};
    if (*place == "charger" && programme_.charger) robot_ = {programme_.charger->x, programme_.charger->y};
    if (const auto* exhibit = programme_.find_exhibit(*place)) robot_ = {exhibit->pose.x, exhibit->pose.y};
  }
  void forget(const GologTerm& action) {
    std::erase_if(running_, [&](const RunningAction& one) { return one.action == action; });
  }
  void say(double now_s, const char* what, const std::string& term = {}) {
    char front[48];
    std::snprintf(front, sizeof front, "%8.1f s  %-8s ", now_s, what);
    std::string line = front + term;
    line.erase(line.find_last_not_of(' ') + 1);
    print_(line);
  }

  task_control::GologProgram& program_;
  const task_control::Programme& programme_;
  const std::function<void(const std::string&)>& print_;
  Point2 robot_;
  std::vector<RunningAction> running_;
  bool is_finished_ = false;
};

}  // namespace

Result<std::vector<TraceEvent>> parse_trace_events(const std::string& text, const std::filesystem::path& file) {
  std::vector<TraceEvent> events;
  std::istringstream lines{text};
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream row{line.substr(0, line.find('#'))};
    std::vector<std::string> words;
    for (std::string word; row >> word;) words.push_back(word);
    if (words.empty()) continue;
    auto event = event_of(std::move(words));
    if (!event) return fail(at(file, number, event.error().message));
    event->line = number;
    if (!events.empty() && event->time_s < events.back().time_s) {
      return fail(at(file, number, "events stand in the order of their times"));
    }
    events.push_back(std::move(*event));
  }
  return events;
}

Result<void> play_trace(task_control::GologProgram& program, const task_control::Programme& programme,
                        const std::vector<TraceEvent>& events, const std::filesystem::path& file, double most_s,
                        const std::function<void(const std::string&)>& print) {
  for (const TraceEvent& event : events) {
    if (event.kind != TraceEvent::Kind::event) continue;
    if (const auto known = program.check_event(event.term); !known)
      return fail(at(file, event.line, known.error().message));
  }
  Player player{program, programme, print};
  double now = 0.0;
  double active = 0.0;  // when something last was under way or came in
  for (std::size_t next = 0; now <= most_s && !player.is_finished();) {
    std::vector<GologTerm> incoming;
    for (; next < events.size() && events[next].time_s <= now; ++next) {
      const TraceEvent& event = events[next];
      active = now;
      if (event.kind == TraceEvent::Kind::event) {
        incoming.push_back(event.term);
        continue;
      }
      if (!player.is_running(event.term)) return fail(at(file, event.line, to_text(event.term) + " is not under way"));
      const bool is_failed = event.kind == TraceEvent::Kind::failed;
      const GologOutcome outcome{is_failed ? GologOutcome::Kind::failed : GologOutcome::Kind::sensed, event.value};
      if (auto ended = player.end(now, event.term, outcome); !ended) return ended;
    }
    if (auto gone = player.go_on(now, std::move(incoming)); !gone) return gone;
    if (player.is_busy()) active = now;
    if (next == events.size() && now - active > kPatience && !player.is_finished()) return player.say_waits(now);
    const double event_s = next < events.size() ? events[next].time_s : std::numeric_limits<double>::infinity();
    now = std::min({now + kTick, player.next_end_s(), std::max(event_s, now)});
  }
  if (!player.is_finished()) player.say_is_up(most_s);
  return {};
}

}  // namespace docent::apps::golog_command
