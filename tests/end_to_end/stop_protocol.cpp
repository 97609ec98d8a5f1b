#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <set>

#include "odd_machine.h"
#include "stop_day.h"
#include "stop_trials.h"

// An acknowledged stop while any two processes of the robot die, in any order, twice, with one gateway and with two, on
// a disk that takes something or nothing; and a day of all that.
//
//   docent_stop_protocol [--gateways 1|2] [--disk free|full] [--pairs keepers|beside|others|A,B;C,D…] [--from N]
//                        [--count N] [--together N] [--controls N] [--day SECONDS] [--seed N] [--domain N] [--port N]
//                        [--report FILE.json]

namespace docent {
namespace {

struct Options : StopRobotOptions {
  bool is_full = false;
  std::string pairs = "keepers";
  std::size_t from = 0, count = 1000;  ///< of the pairs, or of the hours
  std::size_t together = 1;            ///< pairs between a press and its release
  int controls = 1;                    ///< pairs while nobody presses
  double day_s = 0.0;                  ///< of a whole day; 0: pairs
  std::string report;
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

bool is_keeper(const std::string& process) {
  static const std::set<std::string> kKeepers{"avoid", "robot", "web", "gateway 2"};
  return kKeepers.contains(process);
}

/// All of that kind, so ordered that no process is hit again at once: else the back-off that spares what cannot live
/// would be measured.
std::vector<Pair> pairs_of(const std::string& kind, const std::vector<std::string>& processes) {
  std::vector<Pair> all;
  if (kind.find(',') != std::string::npos) {
    for (const std::string& one : split(kind, ';')) {
      const auto two = split(one, ',');
      all.push_back({two.at(0), two.at(1)});
    }
    return all;
  }
  for (const std::string& first : processes) {
    for (const std::string& second : processes) {
      const int keepers = (is_keeper(first) ? 1 : 0) + (is_keeper(second) ? 1 : 0);
      const bool is_wanted = kind == "all" || (kind == "keepers" && keepers == 2) ||
                             (kind == "beside" && keepers == 1) || (kind == "others" && keepers == 0);
      if (first != second && is_wanted) all.push_back({first, second});
    }
  }
  std::mt19937 random{1};
  std::shuffle(all.begin(), all.end(), random);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto shares = [&](const Pair& one) {
      const Pair& last = all[i - 1];
      return one.first == last.first || one.first == last.second || one.second == last.first ||
             one.second == last.second;
    };
    const auto next = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(i), all.end(),
                                   [&](const Pair& one) { return !shares(one); });
    if (next != all.end()) std::iter_swap(all.begin() + static_cast<std::ptrdiff_t>(i), next);
  }
  return all;
}

void print(const StopTrial& trial) {
  std::printf("| %-12s | %-12s | %d | %-4s | %.2f | %.3f | %.3f | %.3f | %-3s | %4.1f | %.2f | %4.1f | %s |\n",
              trial.pair.first.c_str(), trial.pair.second.c_str(), trial.gateways, trial.is_full ? "full" : "free",
              trial.speed, trial.acknowledged_s, trial.way_m, trial.turned, trial.would_drive ? "yes" : "no",
              trial.back_s, trial.released_s, trial.went_s, trial.fault.empty() ? "good" : trial.fault.c_str());
  std::fflush(stdout);
}

nlohmann::json json_of(const StopTrial& trial) {
  return {{"first", trial.pair.first}, {"second", trial.pair.second},    {"gateways", trial.gateways},
          {"full", trial.is_full},     {"speed", trial.speed},           {"acknowledged_s", trial.acknowledged_s},
          {"way_m", trial.way_m},      {"turned", trial.turned},         {"would_drive", trial.would_drive},
          {"back_s", trial.back_s},    {"released_s", trial.released_s}, {"went_s", trial.went_s},
          {"fault", trial.fault}};
}

nlohmann::json json_of(const StopHour& hour) {
  return {{"hour", hour.hour},     {"clock", hour.clock},       {"mode", hour.mode},
          {"killed", hour.killed}, {"full", hour.is_full},      {"acknowledged_s", hour.acknowledged_s},
          {"way_m", hour.way_m},   {"driven_m", hour.driven_m}, {"fault", hour.fault}};
}

void write_report(const std::string& path, const nlohmann::json& report) {
  if (path.empty()) return;
  std::ofstream{path + ".part"} << report.dump(1) << "\n";
  std::filesystem::rename(path + ".part", path);
}

nlohmann::json run_pairs(const Options& options, StopRobot& robot, OddMachine& machine) {
  StopTrials trials{robot, machine, options.is_full};
  nlohmann::json report{{"trials", nlohmann::json::array()}, {"controls", nlohmann::json::array()}};
  std::printf(
      "| first | second | gateways | disk | m/s | acknowledged s | m | rad | had to go | back s | released s | drives "
      "s | |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int i = 0; i < options.controls; ++i) {
    const StopTrial control = trials.run({"sound", "people"}, false);
    print(control);
    report["controls"].push_back(json_of(control));
  }
  const auto all = pairs_of(options.pairs, robot.processes());
  report["of"] = all.size();
  const std::size_t end = std::min(all.size(), options.from + options.count);
  for (std::size_t i = options.from; i < end; i += options.together) {
    const std::vector<Pair> some{all.begin() + static_cast<std::ptrdiff_t>(i),
                                 all.begin() + static_cast<std::ptrdiff_t>(std::min(end, i + options.together))};
    const auto done = some.size() == 1 ? std::vector{trials.run(some.front())} : trials.run_together(some);
    for (const StopTrial& trial : done) {
      print(trial);
      report["trials"].push_back(json_of(trial));
    }
  }
  return report;
}

int run(const Options& options, OddMachine& machine) {
  const bool is_day = options.day_s > 0.0;
  if (is_day) {
    setenv("TZ", kZone, 1);
    machine.ahead_ns =
        (kDayBegins - std::chrono::system_clock::to_time_t(std::chrono::system_clock::now())) * 1'000'000'000;
  }
  StopRobot robot{options};
  if (!robot.begin()) {
    std::printf("the robot or a gateway did not begin:\n%s\n", robot.log().c_str());
    return 1;
  }
  nlohmann::json report;
  if (is_day) {
    report["hours"] = nlohmann::json::array();
    const auto seed = static_cast<unsigned>(std::atoi(options.seed.c_str()));
    for (const StopHour& hour : run_day(robot, machine, options.day_s / 24.0, seed, static_cast<int>(options.from),
                                        static_cast<int>(options.count)))
      report["hours"].push_back(json_of(hour));
  } else {
    report = run_pairs(options, robot, machine);
  }
  machine.is_full = 0;
  const auto whole = robot.report();
  report["refused_writes"] = machine.refused.load();
  report["contacts"] = whole.contacts.all();
  report["area_violations"] = whole.area_violations;
  report["distance_m"] = whole.distance_m;
  report["log"] = robot.log();
  write_report(options.report, report);
  int faults = 0, number = 0;
  for (const char* part : {"trials", "hours"}) {
    for (const auto& one : report.value(part, nlohmann::json::array())) {
      ++number;
      faults += one["fault"] == "" ? 0 : 1;
    }
  }
  std::printf("%d contacts in %.3f km, %d writes refused\n%d passed, %d failed\n", whole.contacts.all(),
              whole.distance_m / 1000.0, machine.refused.load(), number - faults, faults);
  return faults == 0 && number > 0 && whole.contacts.all() == 0 ? 0 : 1;
}

bool take(Options& options, const std::string& name, const std::string& value) {
  if (name == "--gateways")
    options.gateways = std::atoi(value.c_str());
  else if (name == "--disk")
    options.is_full = value == "full";
  else if (name == "--pairs")
    options.pairs = value;
  else if (name == "--from")
    options.from = static_cast<std::size_t>(std::atoi(value.c_str()));
  else if (name == "--count")
    options.count = static_cast<std::size_t>(std::atoi(value.c_str()));
  else if (name == "--together")
    options.together = static_cast<std::size_t>(std::max(1, std::atoi(value.c_str())));
  else if (name == "--controls")
    options.controls = std::atoi(value.c_str());
  else if (name == "--day")
    options.day_s = std::atof(value.c_str()), options.mode = "hours";
  else if (name == "--seed")
    options.seed = value;
  else if (name == "--domain")
    options.domain = std::atoi(value.c_str());
  else if (name == "--port")
    options.port = std::atoi(value.c_str());
  else if (name == "--report")
    options.report = value;
  else
    return false;
  return true;
}

}  // namespace
}  // namespace docent

int main(int argc, char** argv) {
  docent::OddMachine& machine = docent::on_odd_machine(argv);
  docent::Options options;
  for (int i = 1; i < argc; i += 2) {
    if (i + 1 == argc || !docent::take(options, argv[i], argv[i + 1])) {
      std::fprintf(stderr, "docent_stop_protocol: no option %s, or no value for it\n", argv[i]);
      return 2;
    }
  }
  return docent::run(options, machine);
}
