#include "stop_trials.h"

#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace docent {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kDriving = 0.3;       // [m/s]
constexpr double kMoved = 0.005;       // [m]: what a standing base's encoders may say
constexpr double kTurned = 0.02;       // [rad] likewise
constexpr Seconds kLongest = 4s;       // after the second died: a restart, two seconds of asking, and a start
constexpr Seconds kShort = 1.5s;       // where neither keeps the stop
constexpr std::array kApart{50, 600};  // [ms] between the two, the first time and the second

constexpr const char* kNeverDrove = "it never drove";

double since(Clock::time_point begin) { return Seconds{Clock::now() - begin}.count(); }

bool keeps_the_stop(const std::string& process) {
  return process == "avoid" || process == "robot" || process == "web" || process == "gateway 2";
}

void blame(StopTrial& trial, const std::string& fault) { trial.fault += (trial.fault.empty() ? "" : "; ") + fault; }

}  // namespace

/// @returns whether it was driving and now stands, stopped and acknowledged
bool StopTrials::press(StopTrial& trial, bool is_pressed) {
  if (!robot_.drives(kDriving, 60s)) {
    blame(trial, kNeverDrove);
    return false;
  }
  trial.speed = std::abs(robot_.look().truth.linear);
  seen_ = robot_.look().truth;
  machine_.is_full = is_full_ ? 1 : 0;
  if (!is_pressed) return true;
  const auto answer = robot_.at(next_gateway_).press();
  trial.acknowledged_s = answer.after_s;
  if (!answer.is_acknowledged) blame(trial, "not acknowledged: " + answer.why_not);
  if (answer.is_acknowledged && !robot_.stands(3s)) blame(trial, "it did not stand within 3 s");
  seen_ = robot_.look().truth;
  return answer.is_acknowledged;
}

void StopTrials::measure(StopTrial& trial) {
  const auto now = robot_.look().truth;
  trial.way_m += now.distance_m - seen_.distance_m;
  trial.turned += std::abs(std::remainder(now.theta - seen_.theta, 2.0 * M_PI));
  seen_ = now;
}

/// What keeps on a disk what it has promised does not start on one that takes nothing.
bool StopTrials::may_be_away(const std::string& process) const { return is_full_ && process == "mission"; }

void StopTrials::kill_twice(StopTrial& trial, Seconds watched) {
  trial.would_drive = robot_.would_drive();
  for (const int apart : kApart) {
    const auto kill_one = [&](const std::string& process) {
      if (!robot_.hit(process, SIGKILL) && !may_be_away(process)) blame(trial, process + " was not there");
    };
    kill_one(trial.pair.first);
    robot_.wait(std::chrono::milliseconds{apart});
    kill_one(trial.pair.second);
    const auto killed = Clock::now();
    robot_.wait(watched);
    std::vector<std::string> wanted{trial.pair.first, trial.pair.second};
    std::erase_if(wanted, [this](const std::string& process) { return may_be_away(process); });
    if (!robot_.are_back(wanted, 25s)) blame(trial, "not both are back");
    trial.back_s = since(killed);
  }
  measure(trial);
}

void StopTrials::release(StopTrial& trial) {
  if (!robot_.is_everywhere(true, 10s)) blame(trial, "not all say that it is stopped");
  measure(trial);
  if (std::abs(trial.way_m) > kMoved || trial.turned > kTurned) blame(trial, "it moved");
  next_gateway_ = (next_gateway_ + 1) % robot_.gateways();  // whoever pressed is not who releases
  const auto begun = Clock::now();
  const auto answer = robot_.at(next_gateway_).release();
  if (!answer.is_acknowledged) blame(trial, "the release was not acknowledged: " + answer.why_not);
  if (!robot_.is_everywhere(false, 5s)) blame(trial, "not released everywhere");
  trial.released_s = since(begun);
  machine_.is_full = 0;  // on a full disk no request is taken
  if (!robot_.drives(0.1, 40s)) blame(trial, "released, it does not drive");
  trial.went_s = since(begun);
}

StopTrial StopTrials::run(const Pair& pair, bool is_pressed) {
  StopTrial trial;
  trial.pair = pair;
  trial.gateways = robot_.gateways();
  trial.is_full = is_full_;
  if (!press(trial, is_pressed)) {
    if (!trial.fault.starts_with(kNeverDrove)) release(trial);  // the next one begins with a robot that may drive
    return trial;
  }
  kill_twice(trial, kLongest);
  if (!is_pressed) machine_.is_full = 0;
  if (!is_pressed) return trial;
  release(trial);
  return trial;
}

std::vector<StopTrial> StopTrials::run_together(const std::vector<Pair>& pairs) {
  std::vector<StopTrial> trials;
  StopTrial pressed;
  const bool is_stopped = press(pressed, true);
  for (const Pair& pair : pairs) {
    StopTrial trial = pressed;
    trial.pair = pair;
    trial.gateways = robot_.gateways();
    trial.is_full = is_full_;
    const bool matters = keeps_the_stop(pair.first) || keeps_the_stop(pair.second);
    if (is_stopped) kill_twice(trial, matters ? kLongest : kShort);
    const bool is_last = &pair == &pairs.back();
    const bool is_to_be_released = is_stopped || !trial.fault.starts_with(kNeverDrove);
    if (is_to_be_released && is_last) release(trial);
    if (is_stopped && !is_last && (std::abs(trial.way_m) > kMoved || trial.turned > kTurned)) blame(trial, "it moved");
    trials.push_back(std::move(trial));
  }
  return trials;
}

}  // namespace docent
