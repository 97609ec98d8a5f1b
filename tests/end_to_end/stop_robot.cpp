#include "stop_robot.h"

#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "quick_museum.h"

namespace docent {
namespace {

using namespace std::chrono_literals;
using Clock = RobotWatch::Clock;

constexpr const char* kSecondGateway = "gateway 2";
constexpr auto kSilent = 1s;  // a keeper that was not heard for so long is dead

/// The word behind "run" on its command line: which module it is.
std::string module_of(pid_t pid) {
  std::ifstream file{"/proc/" + std::to_string(pid) + "/cmdline"};
  std::string word;
  while (std::getline(file, word, '\0'))
    if (word == "run" && std::getline(file, word, '\0')) return word;
  return "";
}

constexpr const char* kOpen = "open: {max_speed: 0.7";
constexpr const char* kOpenHours = "02:30-18:30";

void set_hours(const std::filesystem::path& museum) {
  std::ifstream file{museum / "museum.yaml"};
  std::string text{std::istreambuf_iterator<char>{file}, {}};
  const auto at = text.find(kOpen);
  if (at == std::string::npos) std::abort();
  text.insert(at + std::string{kOpen}.size(), std::string{", hours: [\""} + kOpenHours + "\"]");
  std::ofstream{museum / "museum.yaml"} << text;
}

}  // namespace

const museum::Museum& StopRobot::museum_with_hours() {
  static const museum::Museum museum = [] {
    museum::Museum made;
    made.modes["open"].hours = {kOpenHours};
    made.modes["web"].hours = {"18:30-21:30"};  // as in Bonn
    return made;
  }();
  return museum;
}

StopRobot::StopRobot(StopRobotOptions options) : options_{std::move(options)}, watch_{options_.domain} {
  make_accounts();
  const std::string museum = with_short_texts(options_.museum, folder_.path() / "museum");
  if (options_.mode == "hours") set_hours(museum);
  up_ = std::make_unique<Program>(std::vector<std::string>{"up",
                                                           "--sim",
                                                           "--museum",
                                                           museum,
                                                           "--state",
                                                           state(0),
                                                           "--domain",
                                                           std::to_string(options_.domain),
                                                           "--port",
                                                           std::to_string(options_.port),
                                                           "--crowd",
                                                           "quiet",
                                                           "--seed",
                                                           options_.seed,
                                                           "--mode",
                                                           options_.mode,
                                                           "--requests-per-hour",
                                                           "0",
                                                           "--no-cameras",
                                                           "--start=9,3.6,90"});
  if (options_.gateways > 1) start_second_gateway();
  for (int i = 0; i < options_.gateways; ++i) operators_.push_back(std::make_unique<OperatorLine>(options_.port + i));
}

void StopRobot::make_accounts() const {
  for (int i = 0; i < options_.gateways; ++i) {
    const std::filesystem::path input = folder_.write("password", std::string{OperatorLine::kPassword} + "\n");
    const std::string command = docent_program().string() + " web-account add " + OperatorLine::kName + " --state " +
                                state(i).string() + " < " + input.string() + " > /dev/null";
    if (std::system(command.c_str()) != 0) std::abort();
  }
}

std::filesystem::path StopRobot::state(int gateway) const {
  return folder_.path() / (gateway == 0 ? "state" : "second");
}

void StopRobot::start_second_gateway() {
  second_ = std::make_unique<Program>(std::vector<std::string>{
      "run", "web", "--museum", folder_.path() / "museum", "--domain", std::to_string(options_.domain), "--state",
      state(1), "--set", "web.port=" + std::to_string(options_.port + 1)});
}

bool StopRobot::begin() {
  const bool is_ready =
      eventually([&] { return watch_.look().localized || !is_running(up_->pid()); }, 120s) && is_running(up_->pid());
  if (!is_ready) std::printf("never localized:\n%s\n", up_->output().c_str());
  bool is_open = is_ready;
  for (const auto& line : operators_) is_open = is_open && line->opens(20s);
  return is_open;
}

std::map<std::string, pid_t> StopRobot::pids() const {
  std::map<std::string, pid_t> found;
  for (const pid_t pid : up_->children()) {
    const std::string module = module_of(pid);
    if (!module.empty() && module != "sim" && is_running(pid)) found[module] = pid;
  }
  if (second_ && is_running(second_->pid())) found[kSecondGateway] = second_->pid();
  return found;
}

std::vector<std::string> StopRobot::processes() const {
  std::vector<std::string> names;
  for (const auto& [name, pid] : pids()) names.push_back(name);
  return names;
}

bool StopRobot::hit(const std::string& process, int signal) {
  const auto all = pids();
  const auto found = all.find(process);
  if (found == all.end()) return false;
  if (signal == SIGKILL) hit_[process] = found->second;
  kill(found->second, signal);
  if (process == kSecondGateway && signal == SIGKILL) start_second_gateway();
  return true;
}

bool StopRobot::are_back(const std::vector<std::string>& processes, Seconds patience) {
  const auto is_back = [&](const std::string& process) {
    const auto all = pids();
    const auto found = all.find(process);
    if (found == all.end() || found->second == hit_[process]) return false;
    if (process == kSecondGateway) return at(1).opens(0s);
    if (process == "web") return at(0).opens(0s);
    const auto now = watch_.look();
    const auto heard = now.health.find(process);
    return heard != now.health.end() && heard->second.health.pid == found->second &&
           heard->second.health.state != "starting";
  };
  return wait_for([&] { return std::all_of(processes.begin(), processes.end(), is_back); }, patience);
}

bool StopRobot::is_everywhere(bool is_stopped, Seconds patience) {
  return wait_for(
      [&] {
        const auto now = watch_.look();
        int living = 0;
        for (const auto& [keeper, word] : now.stops) {
          if (Clock::now() - word.second > kSilent) continue;
          ++living;
          if (word.first.is_stopped != is_stopped || !word.first.is_sure) return false;
        }
        if (living < 2 + options_.gateways) return false;  // avoid, robot and each gateway
        return std::all_of(operators_.begin(), operators_.end(), [&](const auto& line) {
          return line->operation().value("stopped", !is_stopped) == is_stopped;
        });
      },
      patience);
}

void StopRobot::keep_busy() {
  static_cast<void>(up_->output());  // or it would wait for a reader
  if (second_) static_cast<void>(second_->output());
  const auto now = watch_.look();
  const bool has_work = std::any_of(now.board.requests.begin(), now.board.requests.end(), [](const auto& request) {
    return request.state == "queued" || request.state == "active";
  });
  if (has_work || Clock::now() - asked_at_ < 3s) return;
  asked_at_ = Clock::now();
  const std::array exhibits{"particle-trap", "zuse"};
  watch_.ask_for("exhibit", exhibits[next_wish_++ % exhibits.size()]);
}

bool StopRobot::wait_for(const std::function<bool()>& done, Seconds patience) {
  return eventually(
      [&] {
        keep_busy();
        return done();
      },
      patience);
}

void StopRobot::wait(Seconds duration) {
  const auto end = Clock::now() + duration;
  static_cast<void>(wait_for([&] { return Clock::now() >= end; }, duration + 1s));
}

bool StopRobot::drives(double speed, Seconds patience) {
  return wait_for([&] { return std::abs(watch_.look().truth.linear) >= speed; }, patience);
}

bool StopRobot::stands(Seconds patience) {
  return wait_for(
      [&] {
        const auto now = watch_.look();
        return std::abs(now.truth.linear) < 0.005 && std::abs(now.truth.angular) < 0.01;
      },
      patience);
}

bool StopRobot::would_drive() const {
  const auto now = watch_.look();
  return now.goal.state == "driving" || now.goal.state == "blocked" || now.task.state == "driving";
}

}  // namespace docent
