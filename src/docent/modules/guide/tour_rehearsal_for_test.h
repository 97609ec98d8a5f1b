#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "docent/base/check.h"
#include "docent/base/random.h"
#include "docent/messages/conversions.h"
#include "docent/modules/host/module_host.h"
#include "docent/transport/virtual_time_bus.h"

// For tests: mission, executive and sound at work in a museum made of air, with a plan that glides in straight lines.

namespace docent::modules {

inline museum::Museum museum_of_air() {
  museum::Museum museum;
  museum.name = {{"en", "Museum of Air"}, {"de", "Luftmuseum"}};
  museum.languages = {"en", "de"};
  museum.home = {0.0, 0.0, Angle{}};
  const auto add = [&](const std::string& id, double x, double y, bool has_more, bool web_only) {
    museum::Exhibit exhibit;
    exhibit.id = id;
    exhibit.title = {{"en", "The " + id}, {"de", "Das " + id}};
    exhibit.pose = {x, y, Angle::degrees(90)};
    exhibit.short_text = {{"en", "This is the " + id + "."}, {"de", "Das ist " + id + "."}};
    if (has_more) exhibit.long_text = {{"en", "There is much more to tell."}, {"de", "Es gibt noch viel zu sagen."}};
    exhibit.web_only = web_only;
    museum.exhibits.push_back(exhibit);
  };
  add("air", 5, 0, true, false);
  add("breeze", 10, 0, false, false);
  add("cloud", 10, 8, true, false);
  add("dust", 0, 8, true, false);
  add("echo", -6, 3, false, false);
  add("fog", 4, 4, true, true);
  museum.tours.push_back({"all", {{"en", "Everything"}}, {"air", "breeze", "cloud", "dust", "echo"}, std::nullopt});
  museum.tours.push_back({"short", {{"en", "Two minutes"}}, {}, 2.0});
  return museum;
}

/// Stands for localize, plan, avoid and robot: glides to the goal at 0.6 m/s.
class GlidingPlan {
 public:
  explicit GlidingPlan(transport::VirtualTimeHub& hub) : bus_{hub.connect("plan")} {
    belief_ = bus_->publisher(topics::kBelief);
    state_ = bus_->publisher(topics::kGoalState);
    bus_->subscribe<docent_msgs::DriveGoal>(topics::kDriveGoal, [this](const auto& goal) { goal_ = goal; });
    bus_->every(seconds(kStep), [this] { step(); });
  }

  Point2 position{1.0, 1.0};
  bool is_localized = true;
  std::set<std::pair<double, double>> unreachable;
  Time blocked_until{};  ///< the robot stands in a crowd until then
  double driven_m = 0.0;

 private:
  static constexpr double kStep = 0.2;
  void step() {
    docent_msgs::GoalState state;
    state.header.stamp = to_message(bus_->now());
    state.id = goal_.id;
    const Point2 to{goal_.x, goal_.y};
    state.remaining_m = state.straight_m = distance(position, to);
    if (goal_.id.empty()) {
      state.state = "idle";
    } else if (goal_.relocalize) {
      state.state = is_localized ? "arrived" : "turning";
    } else if (!is_localized) {
      state.state = "waiting";
    } else if (unreachable.contains({goal_.x, goal_.y})) {
      state.state = "unreachable";
    } else if (state.remaining_m < 0.05) {
      state.state = "arrived";
    } else if (bus_->now() < blocked_until) {
      state.state = "blocked";
      state.blocked_s = to_seconds(bus_->now() - moved_);
    } else {
      state.state = "driving";
      moved_ = bus_->now();
      const double stride = std::min(kStep * 0.6, state.remaining_m);
      position = position + stride / state.remaining_m * (to - position);
      driven_m += stride;
    }
    state_.publish(std::move(state));
    docent_msgs::Belief belief;
    belief.localized = is_localized;
    belief.hypotheses.push_back({position.x, position.y, 0.0, {}, 1.0});
    belief_.publish(std::move(belief));
  }

  std::unique_ptr<transport::Bus> bus_;
  transport::Publisher<docent_msgs::Belief> belief_;
  transport::Publisher<docent_msgs::GoalState> state_;
  docent_msgs::DriveGoal goal_;
  Time moved_{};
};

/// A visitor's page: sends each wish every two seconds until it sees it on the board (architecture 10.8).
class Client {
 public:
  explicit Client(transport::VirtualTimeHub& hub) : bus_{hub.connect("client")} {
    request_ = bus_->publisher(topics::kRequest);
    bus_->subscribe<docent_msgs::RequestBoard>(topics::kRequestBoard, [this](const auto& board) {
      for (const auto& entry : board.requests) {
        states[entry.request.id] = entry;
        unseen_.erase(entry.request.id);
      }
    });
    bus_->every(seconds(2), [this] {
      for (const auto& [id, request] : unseen_) request_.publish(request);
    });
  }
  void wish(docent_msgs::Request request) {
    unseen_[request.id] = request;
    request_.publish(std::move(request));
  }
  void wish_for(const std::string& id, const std::string& kind, const std::string& target) {
    wish({id, {}, "web", "Ada", kind, target, -1, "en"});
  }
  [[nodiscard]] std::string state_of(const std::string& id) const {
    const auto place = states.find(id);
    return place == states.end() ? "" : place->second.state;
  }

  std::map<std::string, docent_msgs::RequestState> states;

 private:
  std::unique_ptr<transport::Bus> bus_;
  transport::Publisher<docent_msgs::Request> request_;
  std::map<std::string, docent_msgs::Request> unseen_;
};

/// Thrown out of a publish: the process dies there, after what it did before and without what comes behind.
struct Killed {
  std::string module;
};

/// The whole rehearsal. Modules are killed by destroying them, in the middle of a handler if need be.
class Rehearsal {
 public:
  explicit Rehearsal(std::uint64_t seed, const std::string& name)
      : plan{hub},
        client{hub},
        state_{std::filesystem::temp_directory_path() /
               ("docent_" + name + "_" + std::to_string(seed) + "_" + std::to_string(getpid()))} {
    std::filesystem::remove_all(state_);
    std::filesystem::create_directories(state_);
    hub.tap([this](const transport::TopicInfo& topic, Time, const std::shared_ptr<const void>& message) {
      see(topic, message);
    });
    for (const char* module : {"mission", "executive", "sound"}) start(module);
  }
  ~Rehearsal() {
    hosts_.clear();
    std::filesystem::remove_all(state_);
  }
  Rehearsal(const Rehearsal&) = delete;
  Rehearsal& operator=(const Rehearsal&) = delete;

  void start(const std::string& module) {
    auto host = ModuleHost::create(*find_module(module), hub.connect(module), museum, config, {state_, 1, true, 0});
    DOCENT_CHECK(host.has_value());
    hosts_[module] = std::move(*host);
  }
  void kill(const std::string& module) { hosts_.erase(module); }
  [[nodiscard]] bool is_up(const std::string& module) const { return hosts_.contains(module); }
  /// The next publish of the module on this topic kills it.
  void kill_at(const std::string& topic, const std::string& module) { deaths_[topic] = module; }

  /// Runs; returns the modules that were killed on the way.
  std::vector<std::string> run_for(double duration_s) {
    std::vector<std::string> killed;
    const Time end = hub.now() + seconds(duration_s);
    while (hub.now() < end) {
      try {
        hub.run_until(end);
      } catch (const Killed& death) {
        kill(death.module);
        killed.push_back(death.module);
      }
    }
    return killed;
  }

  [[nodiscard]] std::vector<std::string> events_of(const std::string& kind) const {
    std::vector<std::string> subjects;
    for (const auto& event : events) {
      if (event.kind == kind) subjects.push_back(event.subject);
    }
    return subjects;
  }

  transport::VirtualTimeHub hub;
  museum::Museum museum = museum_of_air();
  robot::RobotConfig config;
  GlidingPlan plan;
  Client client;

  docent_msgs::MissionState mission;
  docent_msgs::TaskState task_state;
  docent_msgs::Task task;
  docent_msgs::RequestBoard board;
  std::vector<docent_msgs::Event> events;
  std::vector<docent_msgs::SpeechState> speeches;        ///< each beginning of a speech
  std::set<std::string> heard;                           ///< speeches, begun or over
  std::map<std::string, std::vector<std::string>> told;  ///< request id to the tasks that explained for it

 private:
  template <class T>
  static bool is(const transport::TopicInfo& info, const Topic<T>& topic) {
    return std::string_view{info.name} == topic.name;
  }
  void see(const transport::TopicInfo& info, const std::shared_ptr<const void>& message) {
    const auto death = deaths_.find(info.name);
    if (death != deaths_.end() && is_up(death->second)) {
      const Killed killed{death->second};
      deaths_.erase(death);
      throw killed;
    }
    if (is(info, topics::kMissionState)) mission = *static_cast<const docent_msgs::MissionState*>(message.get());
    if (is(info, topics::kTask)) task = *static_cast<const docent_msgs::Task*>(message.get());
    if (is(info, topics::kRequestBoard)) {
      board = *static_cast<const docent_msgs::RequestBoard*>(message.get());
      active_since_board_.clear();
    }
    if (is(info, topics::kEvent)) {
      const auto& event = *static_cast<const docent_msgs::Event*>(message.get());
      events.push_back(event);
      if (event.kind == "request_active") active_since_board_[event.subject] = event.detail;
    }
    if (is(info, topics::kSpeechState)) {
      const auto& speech = *static_cast<const docent_msgs::SpeechState*>(message.get());
      const bool is_known = std::any_of(speeches.begin(), speeches.end(), [&](const auto& before) {
        return before.id == speech.id && from_message(before.start) == from_message(speech.start);
      });
      heard.insert(speech.id);
      if (speech.state == "speaking" && !is_known) speeches.push_back(speech);
    }
    if (is(info, topics::kTaskState)) {
      task_state = *static_cast<const docent_msgs::TaskState*>(message.get());
      if (task_state.state == "explaining" && task_state.id == task.id) note_explanation();
    }
  }
  void note_explanation() {
    for (const auto& entry : board.requests) {
      const bool wants = entry.request.kind == "tour" ? entry.request.target == task.tour_id && !task.tour_id.empty()
                                                      : entry.request.target == task.exhibit_id;
      if (entry.state == "active" && wants) note_told(entry.request.id);
    }
    // The mission may have died between the events of a change and its board; the change was committed before both.
    for (const auto& [id, target] : active_since_board_) {
      if (target == task.exhibit_id || (target == task.tour_id && !target.empty())) note_told(id);
    }
  }
  void note_told(const std::string& id) {
    auto& tasks = told[id];
    if (std::find(tasks.begin(), tasks.end(), task.id) == tasks.end()) tasks.push_back(task.id);
  }

  std::filesystem::path state_;
  std::map<std::string, std::string> deaths_;
  std::map<std::string, std::string> active_since_board_;  ///< request id to what it wishes for
  std::map<std::string, std::unique_ptr<ModuleHost>> hosts_;
};

}  // namespace docent::modules
