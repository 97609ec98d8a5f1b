#include <signal.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>

#include "docent/geometry/polygon.h"
#include "docent/museum/museum.h"
#include "program.h"
#include "robot_watch.h"

// Kills and stops the modules of a running robot, one after the other, where it hurts, and looks at what happens:
// nothing is touched, the robot stands when it must, the module is back with current state, the tour goes on.
//
//   docent_kill_protocol [--modules a,b] [--signals kill,stop] [--situations driving,hazard,explaining] [--kills N]
//                        [--museum DIR] [--crowd LEVEL] [--seed N] [--domain N] [--port N] [--report FILE.json]
//                        [--slice]

namespace docent {
namespace {

using namespace std::chrono_literals;
using Clock = RobotWatch::Clock;
using Seconds = std::chrono::duration<double>;

constexpr double kMedianBack = 2.0;  // [s] median of the kills of one module
constexpr double kWorstBack = 6.0;   // [s] any kill
constexpr Seconds kStop = 10s;

struct Options {
  std::vector<std::string> modules{"avoid",   "robot",     "localize", "hazards", "plan", "map",
                                   "mission", "executive", "people",   "sound",   "web",  "record"};
  std::vector<std::string> signals{"kill", "stop"};
  std::vector<std::string> situations{"driving", "hazard", "explaining"};
  int kills = 5;  ///< of each module altogether
  std::string museum = std::string{DOCENT_SOURCES} + "/museums/bonn";
  std::string crowd = "quiet";
  std::string seed = "1";
  int domain = 45;
  std::string port = "18045";
  std::string report;
  bool is_verbose = false;
};

/// What a module says of itself and of its work, by which a new process shows that it has the present state.
const char* output_of(const std::string& module) {
  static const std::map<std::string, const char*> kOutputs{
      {"avoid", topics::kAvoidState.name},     {"robot", topics::kCommandVelocity.name},
      {"localize", topics::kBelief.name},      {"hazards", topics::kVirtualScan.name},
      {"plan", topics::kGoalState.name},       {"map", topics::kLiveMap.name},
      {"mission", topics::kMissionState.name}, {"executive", topics::kTaskState.name},
      {"people", topics::kPeople.name},        {"sound", topics::kSpeechState.name}};
  const auto found = kOutputs.find(module);
  return found == kOutputs.end() ? nullptr : found->second;
}

/// Without these nothing may move: their stop must bring the robot to a stand.
bool must_stand_without(const std::string& module) {
  static const std::set<std::string> kNeeded{"avoid", "robot", "localize", "hazards", "plan"};
  return kNeeded.contains(module);
}

struct Trial {
  std::string module;
  std::string signal;
  std::string situation;
  double waited_s = 0.0;          ///< for the situation
  double speed = 0.0;             ///< [m/s] true, at the signal
  std::optional<double> back_s;   ///< until its state was current again: from the kill, or from the continuation
  std::optional<double> stood_s;  ///< until the robot stood, where it must
  bool stood_still = true;        ///< from then to the continuation
  int contacts = 0;
  std::optional<double> went_on_s;  ///< until the tour had gone on
  std::string fault;                ///< empty: good
};

class Protocol {
 public:
  Protocol(Options options, Museum museum)
      : options_{std::move(options)},
        museum_{std::move(museum)},
        watch_{options_.domain},
        up_{{"up", "--sim", "--museum", with_short_texts(), "--state", (state_.path() / "state").string(), "--domain",
             std::to_string(options_.domain), "--port", options_.port, "--crowd", options_.crowd, "--seed",
             options_.seed, "--record", (state_.path() / "kill.mcap").string(), "--requests-per-hour", "0",
             "--start=" + start_pose()}} {}

  /// Localized, with something to do.
  [[nodiscard]] bool begin() {
    const bool is_ready =
        eventually([&] { return watch_.look().localized || !is_running(up_.pid()); }, 180s) && is_running(up_.pid());
    if (!is_ready) std::printf("never localized:\n%s\n", up_.output().c_str());
    return is_ready;
  }

  Trial run(const std::string& module, const std::string& signal, const std::string& situation);
  [[nodiscard]] DeploymentReport report() const { return watch_.report(); }
  [[nodiscard]] std::string log() { return up_.output(); }
  /// A module that this robot runs.
  [[nodiscard]] bool has(const std::string& module) { return watch_.look().health.contains(module); }

 private:
  /// The same museum with little to say: most of the time shall be spent driving.
  [[nodiscard]] std::string with_short_texts() const {
    const auto copy = state_.path() / "museum";
    std::filesystem::copy(options_.museum, copy, std::filesystem::copy_options::recursive);
    for (const auto& entry : std::filesystem::directory_iterator{copy / "content"}) {
      if (entry.path().extension() == ".md") {
        std::ofstream{entry.path()}
            << "Here stands something that is worth a look. Many people have worked on it for years.\n";
      }
    }
    return copy;
  }
  [[nodiscard]] std::string start_pose() const {
    const Pose2& home = museum_.home;
    return std::to_string(home.x) + "," + std::to_string(home.y) + "," + std::to_string(home.theta.degrees());
  }
  void keep_busy();
  [[nodiscard]] bool is_in(const std::string& situation, const RobotWatch::Snapshot& now) const;
  [[nodiscard]] bool is_back(const std::string& module, int old_pid, bool was_killed, Clock::time_point since,
                             const RobotWatch::Snapshot& before) const;
  void show();
  [[nodiscard]] bool wait_for(const std::function<bool()>& done, Seconds patience);

  Options options_;
  Museum museum_;
  TemporaryFolder state_;
  RobotWatch watch_;
  Program up_;
  Clock::time_point asked_at_{};
  Clock::time_point shown_at_{};
  std::size_t next_wish_ = 0;
};

void Protocol::keep_busy() {
  const auto now = watch_.look();
  const bool has_work = std::any_of(now.board.requests.begin(), now.board.requests.end(), [](const auto& request) {
    return request.state == "queued" || request.state == "active";
  });
  if (has_work || Clock::now() - asked_at_ < 5s) return;
  asked_at_ = Clock::now();
  // To and fro through the passage between two glass cases.
  const std::array exhibits{"particle-trap", "zuse"};
  watch_.ask_for("exhibit", exhibits[next_wish_++ % exhibits.size()]);
}

void Protocol::show() {
  if (Clock::now() - shown_at_ < 2s) return;
  shown_at_ = Clock::now();
  const auto now = watch_.look();
  std::fprintf(stderr, "%s/%s, goal %s %.1f m (%s), avoid %s %.2f m/s (%s), at %.1f %.1f, %.2f m/s, %.0f m, %s\n",
               now.mission.phase.c_str(), now.task.state.c_str(), now.goal.state.c_str(), now.goal.remaining_m,
               now.goal.reason.c_str(), now.avoid.state.c_str(), now.avoid.linear, now.avoid.reason.c_str(),
               now.truth.x, now.truth.y, now.truth.linear, now.truth.distance_m, now.localized ? "localized" : "lost");
}

bool Protocol::wait_for(const std::function<bool()>& done, Seconds patience) {
  return eventually(
      [&] {
        keep_busy();
        static_cast<void>(up_.output());
        if (options_.is_verbose) show();
        return done();
      },
      patience);
}

bool Protocol::is_in(const std::string& situation, const RobotWatch::Snapshot& now) const {
  const double speed = std::abs(now.truth.linear);
  if (situation == "driving") return speed >= 0.4;
  if (situation == "explaining") return now.task.state == "explaining" && now.speech.state == "speaking";
  constexpr double kRadius = 0.265;  // [m], the body's
  constexpr double kBeside = 0.6;    // [m] from its outline
  return speed >= 0.2 && std::any_of(museum_.hazards.begin(), museum_.hazards.end(), [&](const Hazard& hazard) {
           return distance(hazard.polygon, {now.truth.x, now.truth.y}) < kRadius + kBeside;
         });
}

bool Protocol::is_back(const std::string& module, int old_pid, bool was_killed, Clock::time_point since,
                       const RobotWatch::Snapshot& before) const {
  const auto now = watch_.look();
  const auto heard = now.health.find(module);
  if (heard == now.health.end() || heard->second.at <= since || heard->second.health.state == "starting") return false;
  if (was_killed == (heard->second.health.pid == old_pid)) return false;
  const char* output = output_of(module);
  if (output != nullptr) {
    const auto last = now.topics.find(output);
    // A latched state whose process was only stopped need not be said again.
    const bool says_it_at_start =
        was_killed || module == "avoid" || module == "robot" || module == "localize" || module == "hazards";
    if (says_it_at_start && (last == now.topics.end() || last->second <= since)) return false;
  }
  if (module == "localize" && before.localized && (!now.localized || now.localized_at <= since)) return false;
  if (module == "mission" && now.board.revision < before.board.revision) return false;
  if (module == "executive" && !before.task.id.empty() && now.task.id.empty()) return false;
  return true;
}

Trial Protocol::run(const std::string& module, const std::string& signal, const std::string& situation) {
  Trial trial;
  trial.module = module;
  trial.signal = signal;
  trial.situation = situation;
  const auto asked = Clock::now();
  RobotWatch::Snapshot before;
  const bool is_there = wait_for(
      [&] {
        before = watch_.look();
        return is_in(situation, before);
      },
      300s);
  trial.waited_s = Seconds{Clock::now() - asked}.count();
  if (!is_there) {
    trial.fault = "the situation never came (" + before.mission.phase + ", " + before.avoid.reason + ")";
    return trial;
  }
  const bool was_killed = signal == "kill";
  const int contacts = watch_.report().contacts.all();
  const int pid = before.health[module].health.pid;
  trial.speed = std::abs(before.truth.linear);
  kill(pid, was_killed ? SIGKILL : SIGSTOP);
  const auto hit = Clock::now();
  auto since = hit;
  if (!was_killed) {
    static_cast<void>(wait_for(
        [&] {
          const double speed = std::abs(watch_.look().truth.linear);
          const double at = Seconds{Clock::now() - hit}.count();
          if (must_stand_without(module)) {
            if (!trial.stood_s && speed < 0.01) trial.stood_s = at;
            // Once every sensor, pose and command has grown old, nothing may move again.
            if (at > 4.0 && speed > 0.02) trial.stood_still = false;
          }
          return at >= kStop.count();
        },
        kStop + 1s));
    since = Clock::now();
    kill(pid, SIGCONT);
  }
  if (wait_for([&] { return is_back(module, pid, was_killed, since, before); }, 20s)) {
    trial.back_s = Seconds{Clock::now() - since}.count();
  }
  // On it goes: another exhibit is explained, or at least three metres are driven.
  if (wait_for(
          [&] {
            const auto now = watch_.look();
            return now.truth.distance_m > before.truth.distance_m + 3.0 ||
                   now.mission.exhibits_explained > before.mission.exhibits_explained;
          },
          180s)) {
    trial.went_on_s = Seconds{Clock::now() - since}.count();
  }
  trial.contacts = watch_.report().contacts.all() - contacts;
  if (trial.contacts > 0) trial.fault = "touched something";
  if (!was_killed && must_stand_without(module) && (!trial.stood_s || !trial.stood_still))
    trial.fault = "did not stand";
  if (!trial.back_s || *trial.back_s > kWorstBack) trial.fault = "not back in time";
  if (!trial.went_on_s) {
    const auto now = watch_.look();
    trial.fault =
        "the tour did not go on (" + now.mission.phase + ", " + now.goal.state + ", " + now.avoid.reason + ")";
  }
  return trial;
}

std::string text_of(const std::optional<double>& value) {
  if (!value) return "-";
  char text[16];
  std::snprintf(text, sizeof text, "%.1f", *value);
  return text;
}

void print_row(const Trial& trial) {
  std::printf("| %-9s | %-4s | %-10s | %5.2f | %6s | %5s | %8d | %7s | %s |\n", trial.module.c_str(),
              trial.signal.c_str(), trial.situation.c_str(), trial.speed, text_of(trial.back_s).c_str(),
              text_of(trial.stood_s).c_str(), trial.contacts, text_of(trial.went_on_s).c_str(),
              trial.fault.empty() ? "good" : trial.fault.c_str());
  std::fflush(stdout);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void write_report(const std::string& path, const std::vector<Trial>& trials, const DeploymentReport& report,
                  bool good) {
  std::ofstream file{path + ".part"};
  file << "{\"good\": " << (good ? "true" : "false") << ",\n \"trials\": [";
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Trial& t = trials[i];
    const auto number = [](const std::optional<double>& value) { return value ? text_of(value) : "null"; };
    file << (i == 0 ? "\n" : ",\n") << "  {\"module\": \"" << t.module << "\", \"signal\": \"" << t.signal
         << "\", \"situation\": \"" << t.situation << "\", \"speed\": " << text_of(t.speed)
         << ", \"back_s\": " << number(t.back_s) << ", \"stood_s\": " << number(t.stood_s)
         << ", \"contacts\": " << t.contacts << ", \"went_on_s\": " << number(t.went_on_s) << ", \"fault\": \""
         << t.fault << "\"}";
  }
  file << "],\n \"report\": " << to_json(report, std::nullopt) << "}\n";
  file.close();
  std::filesystem::rename(path + ".part", path);
}

int run(const Options& options) {
  auto museum = load_museum(options.museum);
  if (!museum) {
    std::fprintf(stderr, "%s\n", museum.error().message.c_str());
    return 2;
  }
  Protocol protocol{options, std::move(*museum)};
  if (!protocol.begin()) return 1;
  std::printf(
      "| module    | hit  | while      |   m/s | back s | stood | contacts | went on | verdict |\n"
      "|-----------|------|------------|-------|--------|-------|----------|---------|---------|\n");
  std::vector<Trial> trials;
  std::map<std::string, std::vector<double>> backs;
  bool is_good = true;
  std::vector<std::string> modules;
  for (const auto& module : options.modules) {
    if (protocol.has(module)) {
      modules.push_back(module);
    } else {
      std::printf("%s does not run\n", module.c_str());
      is_good = false;
    }
  }
  // Round by round over the modules, so that each has lived a while before it is hit again: else the back-off that
  // spares a module that cannot live would be measured.
  for (const auto& signal : options.signals) {
    const int rounds = signal == "kill" ? options.kills : static_cast<int>(options.situations.size());
    for (int round = 0; round < rounds; ++round) {
      const auto& situation = options.situations[static_cast<std::size_t>(round) % options.situations.size()];
      for (const auto& module : modules) {
        trials.push_back(protocol.run(module, signal, situation));
        print_row(trials.back());
        is_good = is_good && trials.back().fault.empty();
        if (signal == "kill") backs[module].push_back(trials.back().back_s.value_or(99.0));
      }
    }
  }
  const DeploymentReport report = protocol.report();
  std::printf("\n");
  for (const auto& [module, all] : backs) {
    const bool is_quick = median(all) <= kMedianBack;
    is_good = is_good && is_quick;
    std::printf("%s  %s back after a kill, median of %zu: %.1f s\n", is_quick ? "pass" : "FAIL", module.c_str(),
                all.size(), median(all));
  }
  std::printf("%s  contacts: %d in %.2f km\n", report.contacts.all() == 0 ? "pass" : "FAIL", report.contacts.all(),
              report.distance_m / 1000.0);
  std::printf("%s  area violations: %d\n", report.area_violations == 0 ? "pass" : "FAIL", report.area_violations);
  std::printf("      %d exhibits explained, %d module restarts\n", report.exhibits_explained, report.module_restarts);
  is_good = is_good && report.contacts.all() == 0 && report.area_violations == 0;
  if (!options.report.empty()) write_report(options.report, trials, report, is_good);
  if (!is_good) std::printf("\nwhat the robot said:\n%s\n", protocol.log().c_str());
  const auto failed = std::count_if(trials.begin(), trials.end(), [](const auto& t) { return !t.fault.empty(); });
  std::printf("%zu passed, %zu failed\n", trials.size() - static_cast<std::size_t>(failed),
              static_cast<std::size_t>(failed));
  return is_good ? 0 : 1;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace
}  // namespace docent

int main(int argc, char** argv) {
  docent::Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--slice") {  // what every run of the tests can afford
      options.modules = {"avoid", "localize", "executive"};
      options.situations = {"driving"};
      options.kills = 1;
      continue;
    }
    if (name == "--verbose") {
      options.is_verbose = true;
      continue;
    }
    if (i + 1 == argc) {
      std::fprintf(stderr, "docent_kill_protocol: %s wants a value\n", name.c_str());
      return 2;
    }
    const std::string value = argv[++i];
    if (name == "--modules")
      options.modules = docent::split(value);
    else if (name == "--signals")
      options.signals = docent::split(value);
    else if (name == "--situations")
      options.situations = docent::split(value);
    else if (name == "--kills")
      options.kills = std::atoi(value.c_str());
    else if (name == "--museum")
      options.museum = value;
    else if (name == "--crowd")
      options.crowd = value;
    else if (name == "--seed")
      options.seed = value;
    else if (name == "--domain")
      options.domain = std::atoi(value.c_str());
    else if (name == "--port")
      options.port = value;
    else if (name == "--report")
      options.report = value;
    else {
      std::fprintf(stderr, "docent_kill_protocol: no option %s\n", name.c_str());
      return 2;
    }
  }
  return docent::run(options);
}
