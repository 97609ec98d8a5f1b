#include "docent/apps/replay/replay_run.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <set>

#include "docent/apps/replay/recorded_voice.h"
#include "docent/apps/shared/temporary_folder.h"
#include "docent/evaluation/deployment_evaluator.h"
#include "docent/evaluation/run_logs/claim_log.h"
#include "docent/localization/belief/checkpoint.h"
#include "docent/messages/conversions.h"
#include "docent/modules/host/module_host.h"
#include "docent/recording/recorder.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent::apps::replay_command {
namespace {

constexpr Duration kAnswerWaits = std::chrono::seconds{20};
constexpr double kCutAtTheEnd = 5.0;  ///< [s]
/// The executive's events: how it goes under way, which is not the same twice; and what is drawn by the seed, which a
/// recording does not tell.
constexpr std::array<const char*, 6> kUnderWay{"arrived",      "drive_blocked", "asked_for_way",
                                               "prompt_shown", "choice",        "attraction_trial"};

/// Publishes decoded messages of any topic.
class Feeder {
 public:
  explicit Feeder(transport::Bus& bus) {
    const auto add = [this, &bus]<class T>(const Topic<T>& topic) {
      publish_[topic.name] = [publisher = bus.publisher(topic)](const std::shared_ptr<const void>& message) {
        publisher.publish(*static_cast<const T*>(message.get()));
      };
    };
    for_each_robot_topic(add);
    for_each_truth_topic(add);
  }
  void publish(const recording::RecordedMessage& message) const { publish_.at(message.topic.name)(message.message); }

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

Result<Extent> extent_of(recording::McapReader& reader) {
  Extent extent;
  const auto read = reader.read([&](const recording::McapMessage& message) {
    if (extent.messages++ == 0) extent.first = message.log_time;
    extent.last = message.log_time;
    return true;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  return extent;
}

Result<RecordedLines> lines_of(recording::McapReader& reader) {
  RecordedLines lines;
  recording::McapReader::Selection speech;
  for (const char* topic : {topics::kSay.name, topics::kSpeechState.name})
    speech.topics.insert(std::string{"/"} + topic);
  const auto read = recording::read_recording(reader, speech, [&](const recording::RecordedMessage& message) {
    lines.add(message);
    return true;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  return lines;
}

std::string replayable() {
  std::string names;
  for (const modules::ModuleEntry& entry : modules::all_modules()) {
    const std::string name = entry.name;
    if (name != "record" && name != "web" && entry.guides) names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

Result<std::vector<const modules::ModuleEntry*>> chosen_modules(const std::vector<std::string>& names) {
  std::vector<const modules::ModuleEntry*> chosen;
  for (const std::string& name : names) {
    if (modules::find_module(name) == nullptr)
      return fail("--modules: no module '" + name + "'; there are " + replayable());
    if (name == "record" || name == "web") return fail("--modules: " + name + " cannot be replayed");
  }
  for (const modules::ModuleEntry& entry : modules::all_modules()) {
    const std::string name = entry.name;
    if (name == "record" || name == "web" || (names.empty() && (name == "sound" || !entry.guides))) continue;
    if (names.empty() || std::find(names.begin(), names.end(), name) != names.end()) chosen.push_back(&entry);
  }
  return chosen;
}

/// Leaves in the state what a localizer leaves that knew its place: `start`, to a few centimetres and degrees, where
/// the recording's odometry begins.
Result<void> tell_start(recording::McapReader& reader, const museum::Museum& museum, const Pose2& start, Time first,
                        const std::filesystem::path& state) {
  constexpr double kPosition = 0.05;  // [m]
  constexpr double kHeading = 0.03;   // [rad]
  std::optional<Pose2> odom_from_robot;
  recording::McapReader::Selection odometry;
  odometry.topics = {std::string{"/"} + topics::kOdometry.name};
  const auto read = recording::read_recording(reader, odometry, [&](const recording::RecordedMessage& message) {
    odom_from_robot = from_message(message.as(topics::kOdometry)->pose.pose);
    return false;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  if (!odom_from_robot) return fail("--start: the recording holds no odometry");
  localization::BeliefMode mode{start, {}, 1.0};
  mode.covariance = {kPosition * kPosition, 0.0, 0.0, 0.0, kPosition * kPosition, 0.0, 0.0, 0.0, kHeading * kHeading};
  return localization::save_localizer_checkpoint({map_hash(museum.map), first, *odom_from_robot, {mode}},
                                                 state / "localize.yaml");
}

/// One replay. Its steps are called in their order, each once; the first error ends it.
class Replay {
 public:
  Replay(const museum::Museum& museum, const robot::RobotConfig& config, const ReplayOptions& options)
      : museum_{museum}, config_{config}, options_{options} {}
  Replay(const Replay&) = delete;
  Replay& operator=(const Replay&) = delete;

  Result<void> open() {
    auto reader = recording::McapReader::open(options_.recording);
    if (!reader) return tl::unexpected<Error>(reader.error());
    reader_.emplace(std::move(*reader));
    const auto extent = extent_of(*reader_);
    if (!extent) return tl::unexpected<Error>(extent.error());
    if (extent->messages == 0) return fail(options_.recording + ": holds no message");
    extent_ = *extent;
    outcome_.seconds = to_seconds(extent_.last - extent_.first);
    auto lines = lines_of(*reader_);
    if (!lines) return fail(options_.recording + ": " + lines.error().message);
    lines_ = std::move(*lines);
    if (options_.out.empty()) return {};
    auto recorder = recording::Recorder::create(options_.out);
    if (!recorder) return tl::unexpected<Error>(recorder.error());
    recorder_.emplace(std::move(*recorder));
    return {};
  }

  Result<void> start(const std::vector<const modules::ModuleEntry*>& modules) {
    if (options_.start) {
      if (auto told = tell_start(*reader_, museum_, *options_.start, extent_.first, state_.path()); !told) return told;
    }
    hub_.run_until(extent_.first);
    hub_.tap([this](const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
      on_published(topic, time, message);
    });
    // Known only when the modules are made; what those publish at their start is theirs in any case.
    theirs_.insert(topics::kEvent.name);
    modules::ModuleHost::Options host_options;
    host_options.state = state_.path();
    host_options.cache = options_.cache;
    host_options.seed = options_.seed;
    host_options.virtual_time = true;
    for (const modules::ModuleEntry* entry : modules) {
      auto host = options_.robot_maker->make(*entry, hub_.connect(entry->name), museum_, config_, host_options);
      if (!host) return tl::unexpected<Error>(host.error());
      hosts_.push_back(std::move(*host));
      chosen_.insert(entry->name);
      outcome_.modules.emplace_back(entry->name);
    }
    theirs_.clear();
    for (const std::string& name : chosen_) theirs_.merge(hub_.topics_published_by(name));
    if (theirs_.contains(topics::kSay.name) && theirs_.insert(topics::kSpeechState.name).second) {
      voice_bus_ = hub_.connect("voice");
      voice_.emplace(*voice_bus_, std::move(lines_));
    }
    if (!theirs_.contains(topics::kEvent.name)) outcome_.repeated.clear();
    return {};
  }

  /// Everything that was recorded, at its time.
  Result<void> feed() {
    const auto bus = hub_.connect("recording");
    const Feeder feeder{*bus};
    const auto choices = bus->publisher(topics::kChoice);
    double shown = 0.0;
    const auto read = recording::read_recording(*reader_, {}, [&](const recording::RecordedMessage& message) {
      hub_.run_until(message.time);
      if (!written_) return false;
      on_recorded(message, feeder);
      for (auto& answer : answers_.take(message.time)) choices.publish(std::move(answer));
      const double share = outcome_.seconds > 0.0 ? since_start(message.time) / outcome_.seconds : 1.0;
      if (options_.progress && share >= shown + 0.01) options_.progress(shown = share);
      return true;
    });
    if (!read) return fail(options_.recording + ": " + read.error().message);
    hub_.run_until(extent_.last);
    hosts_.clear();
    if (recorder_ && written_) written_ = recorder_->close();
    return written_;
  }

  Result<ReplayOutcome> outcome() {
    if (!options_.claims.empty()) {
      if (claims_.claims() == 0) return fail(options_.recording + ": no belief beside a ground truth (/truth/state)");
      if (auto saved = claims_.save(options_.claims); !saved) return tl::unexpected<Error>(saved.error());
    }
    outcome_.replayed_topics.assign(fed_.begin(), fed_.end());
    if (evaluator_.has_truth()) {
      outcome_.report = evaluator_.report();
      outcome_.report->crippled = names_of_both(outcome_.report->crippled, options_.robot_maker->crippled());
    }
    return std::move(outcome_);
  }

 private:
  [[nodiscard]] double since_start(Time time) const { return to_seconds(time - extent_.first); }

  /// Any message of this run, also one that was fed.
  void on_published(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
    evaluator_.add(topic, time, message);
    if (!options_.claims.empty()) claims_.add(topic, time, message);
    const std::string_view name = topic.name;
    if (name == topics::kMissionState.name)
      answers_.present_state(*static_cast<const docent_msgs::MissionState*>(message.get()));
    if (name == topics::kEvent.name && theirs_.contains(topics::kEvent.name)) {
      const auto& event = *static_cast<const docent_msgs::Event*>(message.get());
      outcome_.repeated.push_back({since_start(time), event.kind, event.subject});
    }
    if (recorder_ && written_) written_ = recorder_->write(topic, time, message);
  }

  void on_recorded(const recording::RecordedMessage& message, const Feeder& feeder) {
    if (const auto* mission = message.as(topics::kMissionState)) answers_.recorded_state(*mission);
    const auto* event = message.as(topics::kEvent);
    if (event != nullptr && theirs_.contains(topics::kEvent.name))
      outcome_.recorded.push_back({since_start(message.time), event->kind, event->subject});
    const auto* choice = message.as(topics::kChoice);
    const auto* health = message.as(topics::kHealth);
    if (choice != nullptr && theirs_.contains(topics::kMissionState.name)) {
      answers_.recorded_choice(*choice, message.time);
    } else if (health != nullptr) {
      if (!chosen_.contains(health->module)) feeder.publish(message);
    } else if (!theirs_.contains(message.topic.name)) {
      feeder.publish(message);
      fed_.insert(message.topic.name);
    }
  }

  const museum::Museum& museum_;
  const robot::RobotConfig& config_;
  const ReplayOptions& options_;
  std::optional<recording::McapReader> reader_;
  Extent extent_;
  RecordedLines lines_;
  std::optional<recording::Recorder> recorder_;
  Result<void> written_;  ///< by the recorder; after an error it writes no more
  ReplayOutcome outcome_;
  const TemporaryFolder state_;
  transport::VirtualTimeHub hub_;
  evaluation::DeploymentEvaluator evaluator_;
  evaluation::ClaimLog claims_;
  std::set<std::string> chosen_;  ///< modules
  std::set<std::string> theirs_;  ///< topics of the chosen modules
  std::set<std::string> fed_;     ///< topics of the recording
  Answers answers_;
  std::vector<std::unique_ptr<modules::ModuleHost>> hosts_;
  std::unique_ptr<transport::Bus> voice_bus_;
  std::optional<RecordedVoice> voice_;
};

}  // namespace

Result<ReplayOutcome> replay(const museum::Museum& museum, const robot::RobotConfig& config,
                             const ReplayOptions& options) {
  const auto modules = chosen_modules(options.modules);
  if (!modules) return tl::unexpected<Error>(modules.error());
  Replay replay{museum, config, options};
  if (auto opened = replay.open(); !opened) return tl::unexpected<Error>(opened.error());
  if (auto started = replay.start(*modules); !started) return tl::unexpected<Error>(started.error());
  if (auto fed = replay.feed(); !fed) return tl::unexpected<Error>(fed.error());
  return replay.outcome();
}

Result<std::string> museum_of_recording(const std::string& recording) {
  auto reader = recording::McapReader::open(recording);
  if (!reader) return tl::unexpected<Error>(reader.error());
  recording::McapReader::Selection selection;
  selection.topics = {std::string{"/"} + topics::kRunInfo.name};
  std::string museum;
  const auto read = recording::read_recording(*reader, selection, [&](const recording::RecordedMessage& message) {
    museum = message.as(topics::kRunInfo)->museum;
    return false;
  });
  if (!read) return tl::unexpected<Error>(read.error());
  return museum;
}

std::string names_of_both(const std::string& recorded, const std::string& now) {
  std::vector<std::string_view> known;
  std::string both;
  for (std::string_view names : {std::string_view{recorded}, std::string_view{now}}) {
    while (!names.empty()) {
      const auto end = std::min(names.find(", "), names.size());
      const std::string_view name = names.substr(0, end);
      names.remove_prefix(std::min(end + 2, names.size()));
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      known.push_back(name);
      both.append(both.empty() ? "" : ", ").append(name);
    }
  }
  return both;
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

}  // namespace docent::apps::replay_command
