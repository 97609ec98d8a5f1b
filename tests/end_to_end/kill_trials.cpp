#include "kill_trials.h"

#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <stop_token>
#include <thread>

#include "docent/geometry/polygon.h"
#include "quick_museum.h"

namespace docent {
namespace {

using namespace std::chrono_literals;
using Clock = RobotWatch::Clock;
using Seconds = std::chrono::duration<double>;

constexpr Seconds kStop = 12s;  // longer than the lease that DDS gives by itself, 10 s

/// What a module says of itself and of its work, by which a new process shows that it has the present state.
const char* output_of(const std::string& module) {
  static const std::map<std::string, const char*> kOutputs{
      {"avoid", topics::kAvoidState.name},     {"robot", topics::kCommandVelocity.name},
      {"localize", topics::kBelief.name},      {"hazards", topics::kVirtualScan.name},
      {"plan", topics::kGoalState.name},       {"map", topics::kLiveMap.name},
      {"mission", topics::kMissionState.name}, {"executive", topics::kTaskState.name},
      {"people", topics::kPeople.name},        {"sound", topics::kSpeechState.name},
      {"head", topics::kExpression.name}};
  const auto found = kOutputs.find(module);
  return found == kOutputs.end() ? nullptr : found->second;
}

/// Without these nothing may move: their stop must bring the robot to a stand.
bool must_stand_without(const std::string& module) {
  static const std::set<std::string> kNeeded{"avoid", "robot", "localize", "hazards", "plan"};
  return kNeeded.contains(module);
}

}  // namespace

KillTrials::KillTrials(KillTrialOptions options, museum::Museum museum)
    : options_{std::move(options)},
      museum_{std::move(museum)},
      watch_{options_.domain},
      up_{{"up", "--sim", "--museum", with_short_texts(options_.museum, state_.path() / "museum"), "--state",
           (state_.path() / "state").string(), "--domain", std::to_string(options_.domain), "--port", options_.port,
           "--crowd", options_.crowd, "--seed", options_.seed, "--record", (state_.path() / "kill.mcap").string(),
           "--requests-per-hour", "0", "--start=" + start_pose()}} {}

bool KillTrials::begin() {
  const bool is_ready =
      eventually([&] { return watch_.look().localized || !is_running(up_.pid()); }, 180s) && is_running(up_.pid());
  if (!is_ready) std::printf("never localized:\n%s\n", up_.output().c_str());
  return is_ready;
}

std::string KillTrials::start_pose() const {
  const Pose2& home = museum_.home;
  return std::to_string(home.x) + "," + std::to_string(home.y) + "," + std::to_string(home.theta.degrees());
}

void KillTrials::keep_busy() {
  const auto now = watch_.look();
  const bool has_work = std::any_of(now.board.requests.begin(), now.board.requests.end(), [](const auto& request) {
    return request.state == "queued" || request.state == "active";
  });
  if (has_work || Clock::now() - asked_at_ < 5s) return;
  asked_at_ = Clock::now();
  // Past glass cases, a plate and a podium.
  const std::array exhibits{"particle-trap", "zeolite", "heart-lung", "zuse"};
  watch_.ask_for("exhibit", exhibits[next_wish_++ % exhibits.size()]);
}

void KillTrials::show() {
  if (Clock::now() - shown_at_ < 2s) return;
  shown_at_ = Clock::now();
  const auto now = watch_.look();
  std::fprintf(stderr, "%s/%s, goal %s %.1f m (%s), avoid %s %.2f m/s (%s), at %.1f %.1f, %.2f m/s, %.0f m, %s\n",
               now.mission.phase.c_str(), now.task.state.c_str(), now.goal.state.c_str(), now.goal.remaining_m,
               now.goal.reason.c_str(), now.avoid.state.c_str(), now.avoid.linear, now.avoid.reason.c_str(),
               now.truth.x, now.truth.y, now.truth.linear, now.truth.distance_m, now.localized ? "localized" : "lost");
}

bool KillTrials::wait_for(const std::function<bool()>& done, Seconds patience) {
  return eventually(
      [&] {
        keep_busy();
        static_cast<void>(up_.output());
        if (options_.is_verbose) show();
        return done();
      },
      patience);
}

bool KillTrials::is_in(const std::string& situation, const RobotWatch::Snapshot& now) const {
  const double speed = std::abs(now.truth.linear);
  if (situation == "driving") return speed >= 0.4;
  if (situation == "explaining") return now.task.state == "explaining" && now.speech.state == "speaking";
  if (situation == "asking") return now.task.state == "asking";
  constexpr double kRadius = 0.265;  // [m], the body's
  constexpr double kBeside = 0.95;   // [m] from its outline: as near as ways of today lead past one
  return speed >= 0.2 && std::any_of(museum_.hazards.begin(), museum_.hazards.end(), [&](const museum::Hazard& hazard) {
           return distance(hazard.polygon, {now.truth.x, now.truth.y}) < kRadius + kBeside;
         });
}

bool KillTrials::is_back(const std::string& module, int old_pid, bool was_killed, Clock::time_point since,
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

/// Stops a process for longer than its bus waits for it, and sees what the robot does meanwhile.
void KillTrials::hold_up(int pid, KillTrial& trial) {
  kill(pid, SIGSTOP);
  const auto hit = Clock::now();
  static_cast<void>(wait_for(
      [&] {
        const double speed = std::abs(watch_.look().truth.linear);
        const double at = Seconds{Clock::now() - hit}.count();
        if (must_stand_without(trial.module)) {
          if (!trial.stood_s && speed < 0.01) trial.stood_s = at;
          // Once every sensor, pose and command has grown old, nothing may move again.
          if (at > 4.0 && speed > 0.02) trial.stood_still = false;
        }
        return at >= kStop.count();
      },
      kStop + 1s));
}

/// Leaves a process a tenth of the time, for as long as others are stopped.
void KillTrials::slow_down(int pid) {
  const std::jthread brake{[pid](const std::stop_token& end) {
    while (!end.stop_requested()) {
      kill(pid, SIGSTOP);
      std::this_thread::sleep_for(90ms);
      kill(pid, SIGCONT);
      std::this_thread::sleep_for(10ms);
    }
  }};
  static_cast<void>(wait_for([end = Clock::now() + kStop] { return Clock::now() >= end; }, kStop + 1s));
}

/// Whether the robot goes on: another exhibit is explained, or at least three metres are driven.
bool KillTrials::goes_on(const RobotWatch::Snapshot& before) {
  return wait_for(
      [&] {
        const auto now = watch_.look();
        return now.truth.distance_m > before.truth.distance_m + 3.0 ||
               now.mission.exhibits_explained > before.mission.exhibits_explained;
      },
      180s);
}

KillTrial KillTrials::run(const std::string& module, const std::string& signal, const std::string& situation) {
  KillTrial trial;
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
  if (was_killed) {
    kill(pid, SIGKILL);
  } else if (signal == "slow") {
    slow_down(pid);
  } else {
    hold_up(pid, trial);
  }
  const auto since = Clock::now();
  if (!was_killed) kill(pid, SIGCONT);
  if (wait_for([&] { return is_back(module, pid, was_killed, since, before); }, 20s)) {
    trial.back_s = Seconds{Clock::now() - since}.count();
  }
  if (goes_on(before)) trial.went_on_s = Seconds{Clock::now() - since}.count();
  trial.contacts = watch_.report().contacts.all() - contacts;
  if (trial.contacts > 0) trial.fault = "touched something";
  if (signal == "stop" && must_stand_without(module) && (!trial.stood_s || !trial.stood_still))
    trial.fault = "did not stand";
  if (!trial.back_s || *trial.back_s > kWorstBack) trial.fault = "not back in time";
  if (!trial.went_on_s) {
    const auto now = watch_.look();
    trial.fault =
        "the tour did not go on (" + now.mission.phase + ", " + now.goal.state + ", " + now.avoid.reason + ")";
  }
  return trial;
}

}  // namespace docent
