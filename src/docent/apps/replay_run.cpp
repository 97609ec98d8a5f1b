#include "docent/apps/replay_run.h"

#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>

#include "docent/apps/recorded_voice.h"
#include "docent/evaluation/deployment_evaluator.h"
#include "docent/evaluation/run_logs/claim_log.h"
#include "docent/localization/belief/checkpoint.h"
#include "docent/messages/conversions.h"
#include "docent/modules/module_host.h"
#include "docent/recording/recorder.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent {
namespace {

constexpr Duration kAnswerWaits = std::chrono::seconds{20};
constexpr double kCutAtTheEnd = 5.0;  ///< [s]
/// The executive's events: how it goes under way, which is not the same twice.
constexpr std::array<const char*, 5> kUnderWay{"arrived", "drive_blocked", "asked_for_way", "prompt_shown", "choice"};

/// A folder of its own that goes when the run goes.
class TemporaryState {
 public:
  TemporaryState() {
    std::string name = (std::filesystem::temp_directory_path() / "docent-replay-XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryState() {
    std::error_code code;
    if (!path_.empty()) std::filesystem::remove_all(path_, code);
  }
  TemporaryState(const TemporaryState&) = delete;
  TemporaryState& operator=(const TemporaryState&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Publishes decoded messages of any topic.
class Feeder {
 public:
  explicit Feeder(Bus& bus) {
    const auto add = [this, &bus]<class T>(const Topic<T>& topic) {
      publish_[topic.name] = [publisher = bus.publisher(topic)](const std::shared_ptr<const void>& message) {
        publisher.publish(*static_cast<const T*>(message.get()));
      };
    };
    for_each_robot_topic(add);
    for_each_truth_topic(add);
  }
  void publish(const RecordedMessage& message) const { publish_.at(message.topic.name)(message.message); }

 private:
  std::map<std::string, std::function<void(const std::shared_ptr<const void>&)>, std::less<>> publish_;
};

/// Gives recorded answers to the questions of this run.
class Answers {
 public:
  void recorded_state(const docent_msgs::MissionState& mission) {
    if (!mission.prompt.id.empty()) exhibit_of_[mission.prompt.id] = mission.exhibit_id;
  }
  void recorded_choice(const docent_msgs::Choice& choice, Time now) { waiting_.push_back({choice, now}); }
  void present_state(const docent_msgs::MissionState& mission) {
    prompt_ = mission.prompt.id;
    exhibit_ = mission.exhibit_id;
  }
  /// Answers that fit the question on show now.
  [[nodiscard]] std::vector<docent_msgs::Choice> take(Time now) {
    std::vector<docent_msgs::Choice> ready;
    std::erase_if(waiting_, [&](Waiting& answer) {
      if (now - answer.since > kAnswerWaits) return true;
      const auto exhibit = exhibit_of_.find(answer.choice.prompt_id);
      if (prompt_.empty() || exhibit == exhibit_of_.end() || exhibit->second != exhibit_) return false;
      answer.choice.prompt_id = prompt_;
      ready.push_back(std::move(answer.choice));
      return true;
    });
    return ready;
  }

 private:
  struct Waiting {
    docent_msgs::Choice choice;
    Time since;
  };
  std::map<std::string, std::string> exhibit_of_;  ///< recorded prompts
  std::vector<Waiting> waiting_;
  std::string prompt_;  ///< of this run, on show
  std::string exhibit_;
};

struct Extent {
  Time first{};
  Time last{};
  std::uint64_t messages = 0;
};

Result<Extent> extent_of(McapReader& reader) {
  Extent extent;
  const auto read = reader.read([&](const McapMessage& message) {
    if (extent.messages++ == 0) extent.first = message.log_time;
    extent.last = message.log_time;
    return true;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  return extent;
}

Result<RecordedLines> lines_of(McapReader& reader) {
  RecordedLines lines;
  McapReader::Selection speech;
  for (const char* topic : {topics::kSay.name, topics::kSpeechState.name})
    speech.topics.insert(std::string{"/"} + topic);
  const auto read = read_recording(reader, speech, [&](const RecordedMessage& message) {
    lines.add(message);
    return true;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  return lines;
}

std::string replayable() {
  std::string names;
  for (const ModuleEntry& entry : all_modules()) {
    const std::string name = entry.name;
    if (name != "record" && name != "web") names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

Result<std::vector<const ModuleEntry*>> chosen_modules(const std::vector<std::string>& names) {
  std::vector<const ModuleEntry*> chosen;
  for (const std::string& name : names) {
    if (find_module(name) == nullptr) return fail("--modules: no module '" + name + "'; there are " + replayable());
    if (name == "record" || name == "web") return fail("--modules: " + name + " cannot be replayed");
  }
  for (const ModuleEntry& entry : all_modules()) {
    const std::string name = entry.name;
    if (name == "record" || name == "web" || (names.empty() && name == "sound")) continue;
    if (names.empty() || std::find(names.begin(), names.end(), name) != names.end()) chosen.push_back(&entry);
  }
  return chosen;
}

/// Leaves in the state what a localizer leaves that knew its place: `start`, to a few centimetres and degrees, where
/// the recording's odometry begins.
Result<void> tell_start(McapReader& reader, const Museum& museum, const Pose2& start, Time first,
                        const std::filesystem::path& state) {
  constexpr double kPosition = 0.05;  // [m]
  constexpr double kHeading = 0.03;   // [rad]
  std::optional<Pose2> odom_from_robot;
  McapReader::Selection odometry;
  odometry.topics = {std::string{"/"} + topics::kOdometry.name};
  const auto read = read_recording(reader, odometry, [&](const RecordedMessage& message) {
    odom_from_robot = from_message(message.as(topics::kOdometry)->pose.pose);
    return false;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  if (!odom_from_robot) return fail("--start: the recording holds no odometry");
  BeliefMode mode{start, {}, 1.0};
  mode.covariance = {kPosition * kPosition, 0.0, 0.0, 0.0, kPosition * kPosition, 0.0, 0.0, 0.0, kHeading * kHeading};
  return save_localizer_checkpoint({map_hash(museum.map), first, *odom_from_robot, {mode}}, state / "localize.yaml");
}

}  // namespace

Result<ReplayOutcome> replay(const Museum& museum, const RobotConfig& config, const ReplayOptions& options) {
  const auto chosen = chosen_modules(options.modules);
  if (!chosen) return tl::unexpected<Error>(chosen.error());
  auto reader = McapReader::open(options.recording);
  if (!reader) return tl::unexpected<Error>(reader.error());
  const auto extent = extent_of(*reader);
  if (!extent) return tl::unexpected<Error>(extent.error());
  if (extent->messages == 0) return fail(options.recording + ": holds no message");
  auto lines = lines_of(*reader);
  if (!lines) return fail(options.recording + ": " + lines.error().message);
  std::optional<Recorder> recorder;
  if (!options.out.empty()) {
    auto made = Recorder::create(options.out);
    if (!made) return tl::unexpected<Error>(made.error());
    recorder.emplace(std::move(*made));
  }

  ReplayOutcome outcome;
  outcome.seconds = to_seconds(extent->last - extent->first);
  const TemporaryState state;
  if (options.start) {
    if (auto told = tell_start(*reader, museum, *options.start, extent->first, state.path()); !told)
      return tl::unexpected<Error>(told.error());
  }
  VirtualTimeHub hub;
  hub.run_until(extent->first);
  DeploymentEvaluator evaluator;
  ClaimLog claims;
  Result<void> failure;
  std::set<std::string> theirs;  ///< topics of the chosen modules
  std::set<std::string> chosen_names;
  Answers answers;
  const auto since_start = [&](Time time) { return to_seconds(time - extent->first); };
  hub.tap([&](const TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
    evaluator.add(topic, time, message);
    if (!options.claims.empty()) claims.add(topic, time, message);
    const std::string_view name = topic.name;
    if (name == topics::kMissionState.name)
      answers.present_state(*static_cast<const docent_msgs::MissionState*>(message.get()));
    if (name == topics::kEvent.name && theirs.contains(topics::kEvent.name)) {
      const auto& event = *static_cast<const docent_msgs::Event*>(message.get());
      outcome.repeated.push_back({since_start(time), event.kind, event.subject});
    }
    if (recorder && failure) failure = recorder->write(topic, time, message);
  });

  std::vector<std::unique_ptr<ModuleHost>> hosts;
  // Known only when the modules are made; what those publish at their start is theirs in any case.
  theirs.insert(topics::kEvent.name);
  for (const ModuleEntry* entry : *chosen) {
    ModuleHost::Options host_options;
    host_options.state = state.path();
    host_options.cache = options.cache;
    host_options.seed = options.seed;
    host_options.virtual_time = true;
    auto host = ModuleHost::create(*entry, hub.connect(entry->name), museum, config, host_options);
    if (!host) return tl::unexpected<Error>(host.error());
    hosts.push_back(std::move(*host));
    chosen_names.insert(entry->name);
    outcome.modules.emplace_back(entry->name);
  }
  theirs.clear();
  for (const std::string& name : chosen_names) theirs.merge(hub.topics_published_by(name));
  std::unique_ptr<Bus> voice_bus;
  std::optional<RecordedVoice> voice;
  if (theirs.contains(topics::kSay.name) && theirs.insert(topics::kSpeechState.name).second) {
    voice_bus = hub.connect("voice");
    voice.emplace(*voice_bus, std::move(*lines));
  }
  if (!theirs.contains(topics::kEvent.name)) outcome.repeated.clear();

  const auto feeder_bus = hub.connect("recording");
  const Feeder feeder{*feeder_bus};
  const auto choices = feeder_bus->publisher(topics::kChoice);
  const bool translates = theirs.contains(topics::kMissionState.name);
  std::set<std::string> fed;
  double shown = 0.0;
  const auto read = read_recording(*reader, {}, [&](const RecordedMessage& message) {
    hub.run_until(message.time);
    if (!failure) return false;
    if (const auto* mission = message.as(topics::kMissionState)) answers.recorded_state(*mission);
    const auto* event = message.as(topics::kEvent);
    if (event != nullptr && theirs.contains(topics::kEvent.name))
      outcome.recorded.push_back({since_start(message.time), event->kind, event->subject});
    const auto* choice = message.as(topics::kChoice);
    const auto* health = message.as(topics::kHealth);
    if (choice != nullptr && translates) {
      answers.recorded_choice(*choice, message.time);
    } else if (health != nullptr) {
      if (!chosen_names.contains(health->module)) feeder.publish(message);
    } else if (!theirs.contains(message.topic.name)) {
      feeder.publish(message);
      fed.insert(message.topic.name);
    }
    for (auto& answer : answers.take(message.time)) choices.publish(std::move(answer));
    const double share = outcome.seconds > 0.0 ? since_start(message.time) / outcome.seconds : 1.0;
    if (options.progress && share >= shown + 0.01) options.progress(shown = share);
    return true;
  });
  if (!read) return tl::unexpected<Error>(Error{options.recording + ": " + read.error().message});
  hub.run_until(extent->last);
  hosts.clear();
  if (recorder && failure) failure = recorder->close();
  if (!failure) return tl::unexpected<Error>(failure.error());
  if (!options.claims.empty()) {
    if (claims.claims() == 0) return fail(options.recording + ": no belief beside a ground truth (/truth/state)");
    if (auto saved = claims.save(options.claims); !saved) return tl::unexpected<Error>(saved.error());
  }
  outcome.replayed_topics.assign(fed.begin(), fed.end());
  if (evaluator.has_truth()) outcome.report = evaluator.report();
  if (const auto names = config.evaluation().crippled(); outcome.report && !names.empty()) {
    std::string& crippled = outcome.report->crippled;
    crippled += (crippled.empty() || crippled == names ? "" : ", ") + (crippled == names ? "" : names);
  }
  return outcome;
}

Result<std::string> museum_of_recording(const std::string& recording) {
  auto reader = McapReader::open(recording);
  if (!reader) return tl::unexpected<Error>(reader.error());
  McapReader::Selection selection;
  selection.topics = {std::string{"/"} + topics::kRunInfo.name};
  std::string museum;
  const auto read = read_recording(*reader, selection, [&](const RecordedMessage& message) {
    museum = message.as(topics::kRunInfo)->museum;
    return false;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  return museum;
}

bool ReplayEvent::is_of_mission() const {
  return std::find(kUnderWay.begin(), kUnderWay.end(), kind) == kUnderWay.end();
}

std::string first_difference(const std::vector<ReplayEvent>& recorded, const std::vector<ReplayEvent>& repeated,
                             double duration_s) {
  const auto of_mission = [](const std::vector<ReplayEvent>& events) {
    std::vector<ReplayEvent> chosen;
    std::copy_if(events.begin(), events.end(), std::back_inserter(chosen),
                 [](const auto& e) { return e.is_of_mission(); });
    return chosen;
  };
  const auto a = of_mission(recorded);
  const auto b = of_mission(repeated);
  const auto words = [](const std::vector<ReplayEvent>& events, std::size_t i) {
    if (i >= events.size()) return std::string{"nothing more"};
    char at[32];
    std::snprintf(at, sizeof at, " at %.1f s", events[i].at_s);
    return events[i].kind + (events[i].subject.empty() ? "" : " " + events[i].subject) + at;
  };
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    if (i < a.size() && i < b.size() && a[i] == b[i]) continue;
    const bool one_has_ended = i >= a.size() || i >= b.size();
    if (one_has_ended && (i < a.size() ? a : b)[i].at_s > duration_s - kCutAtTheEnd) return {};
    return "event " + std::to_string(i + 1) + ": recorded " + words(a, i) + ", now " + words(b, i);
  }
  return {};
}

}  // namespace docent
