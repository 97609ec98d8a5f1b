#include "stop_day.h"

#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <random>

#include "docent/museum/museum.h"

namespace docent {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr int kHoursOfDay = 24;
constexpr double kStill = 0.005;  // [m]
constexpr std::int64_t kNanoseconds = 1'000'000'000;

std::int64_t true_ns(const OddMachine& machine) {
  return std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count() - machine.ahead_ns;
}

/// The day, hour by hour.
class Day {
 public:
  Day(StopRobot& robot, OddMachine& machine, double hour_s, unsigned seed)
      : robot_{robot}, machine_{machine}, hour_s_{hour_s}, random_{seed} {}

  StopHour run(int hour) {
    hour_ = {};
    hour_.hour = hour;
    const auto begun = Clock::now();
    const double driven = robot_.distance();
    set_clock(hour, 5);
    if (hour % 6 == 4) set_back_and_forth(hour);
    check_hours();
    if (chance(3)) fill_disk();
    const bool is_stopped = press();
    if (is_stopped) kill_some();
    set_clock(hour, 1805);  // also while it is stopped
    check_hours();
    if (is_stopped) release(chance(2));
    machine_.is_full = 0;
    robot_.wait(Seconds{std::max(0.0, hour_s_ - Seconds{Clock::now() - begun}.count())});
    hour_.driven_m = robot_.distance() - driven;
    return hour_;
  }

 private:
  [[nodiscard]] bool chance(unsigned of) { return random_() % of == 0; }
  void blame(const std::string& fault) { hour_.fault += (hour_.fault.empty() ? "" : "; ") + fault; }
  void set_clock(int hour, int second) {
    const std::int64_t wanted = (kDayBegins + std::int64_t{3600} * hour + second) * kNanoseconds;
    machine_.ahead_ns = wanted - true_ns(machine_);
  }
  void set_back_and_forth(int hour) {
    machine_.ahead_ns -= 61 * 60 * kNanoseconds;
    hour_.clock = "back 61 min, and forth";
    check_hours();
    set_clock(hour, 20);
  }
  void fill_disk() {
    machine_.is_full = 1;
    hour_.is_full = true;
  }
  [[nodiscard]] static std::string expected_mode() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm local{};
    localtime_r(&now, &local);
    return museum::mode_at(StopRobot::museum_with_hours(), local.tm_hour * 60 + local.tm_min);
  }
  /// Every gateway says whose hours these are by the clock on the wall.
  void check_hours() {
    hour_.mode = expected_mode();
    for (int i = 0; i < robot_.gateways(); ++i) {
      std::string said;
      const bool is_right = robot_.wait_for([&] { return (said = robot_.at(i).hours()) == hour_.mode; }, 4s);
      if (!is_right) blame("gateway " + std::to_string(i + 1) + " says " + said + ", it is " + hour_.mode);
    }
  }
  [[nodiscard]] bool press() {
    static_cast<void>(robot_.drives(0.3, Seconds{hour_s_ / 6.0}));  // at night it has nowhere to go
    gateway_ = static_cast<int>(random_() % static_cast<unsigned>(robot_.gateways()));
    const auto answer = robot_.at(gateway_).press();
    hour_.acknowledged_s = answer.after_s;
    if (!answer.is_acknowledged) blame("not acknowledged: " + answer.why_not);
    if (answer.is_acknowledged && !robot_.stands(3s)) blame("it did not stand");
    seen_ = robot_.distance();
    return answer.is_acknowledged;
  }
  void kill_some() {
    auto all = robot_.processes();
    std::shuffle(all.begin(), all.end(), random_);
    const std::vector<std::string> dying{all.at(0), all.at(1)};
    hour_.killed = dying[0] + ", " + dying[1];
    for (const std::string& process : dying) {
      static_cast<void>(robot_.hit(process, SIGKILL));
      robot_.wait(std::chrono::milliseconds{random_() % 800});
    }
    const std::string& hangs = all.at(2);
    if (chance(2)) {
      hour_.killed += "; " + hangs + " hung 3 s";
      static_cast<void>(robot_.hit(hangs, SIGSTOP));
      robot_.wait(3s);
      static_cast<void>(robot_.hit(hangs, SIGCONT));
    }
    robot_.wait(4s);
    std::vector<std::string> wanted = dying;
    // It keeps on a disk what it has promised, and does not start on one that takes nothing.
    if (hour_.is_full) std::erase(wanted, "mission");
    if (!robot_.are_back(wanted, 20s)) blame("not both are back");
  }
  void release(bool is_disk_emptied_first) {
    if (is_disk_emptied_first) machine_.is_full = 0;
    if (!robot_.is_everywhere(true, 10s)) blame("not all say that it is stopped");
    hour_.way_m = robot_.distance() - seen_;
    if (std::abs(hour_.way_m) > kStill) blame("it moved");
    const auto answer = robot_.at((gateway_ + 1) % robot_.gateways()).release();
    if (!answer.is_acknowledged) blame("the release was not acknowledged: " + answer.why_not);
    if (!robot_.is_everywhere(false, 5s)) blame("not released everywhere");
  }

  StopRobot& robot_;
  OddMachine& machine_;
  const double hour_s_;
  std::mt19937 random_;
  StopHour hour_;
  int gateway_ = 0;
  double seen_ = 0.0;
};

}  // namespace

std::vector<StopHour> run_day(StopRobot& robot, OddMachine& machine, double hour_s, unsigned seed, int from,
                              int count) {
  Day day{robot, machine, hour_s, seed};
  std::vector<StopHour> hours;
  for (int hour = from; hour < std::min(kHoursOfDay, from + count); ++hour) {
    hours.push_back(day.run(hour));
    const StopHour& it = hours.back();
    std::printf("| %2d | %-22s | %-6s | %-34s | %-4s | %.2f | %.3f | %.1f | %s |\n", it.hour, it.clock.c_str(),
                it.mode.c_str(), it.killed.c_str(), it.is_full ? "full" : "", it.acknowledged_s, it.way_m, it.driven_m,
                it.fault.empty() ? "good" : it.fault.c_str());
    std::fflush(stdout);
  }
  return hours;
}

}  // namespace docent
