#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "kill_trials.h"

// Kills and stops the modules of a running robot, one after the other, where it hurts, and looks at what happens:
// nothing is touched, the robot stands when it must, the module is back with current state, the tour goes on.
//
//   docent_kill_protocol [--modules a,b] [--signals kill,stop,slow] [--situations driving,hazard,explaining,asking]
//                        [--kills N] [--museum DIR] [--crowd LEVEL] [--seed N] [--domain N] [--port N]
//                        [--report FILE.json] [--slice]

namespace docent {
namespace {

constexpr double kMedianBack = 2.0;  // [s] of the kills of one module

struct Options : KillTrialOptions {
  std::vector<std::string> modules{"avoid", "robot",   "localize", "calibrate", "hazards",     "plan",
                                   "map",   "mission", "people",   "executive", "sound",       "buttons",
                                   "head",  "web",     "record",   "visualize", "scene_camera"};
  std::vector<std::string> signals{"kill", "stop", "slow"};
  std::vector<std::string> situations{"driving", "hazard", "explaining"};
  int kills = 5;  ///< of each module altogether
  std::string report;
};

std::string text_of(const std::optional<double>& value) {
  if (!value) return "-";
  char text[16];
  std::snprintf(text, sizeof text, "%.1f", *value);
  return text;
}

void print_row(const KillTrial& trial) {
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

void write_report(const std::string& path, const std::vector<KillTrial>& trials,
                  const evaluation::DeploymentReport& report, bool good) {
  std::ofstream file{path + ".part"};
  file << "{\"good\": " << (good ? "true" : "false") << ",\n \"trials\": [";
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const KillTrial& t = trials[i];
    const auto number = [](const std::optional<double>& value) { return value ? text_of(value) : "null"; };
    file << (i == 0 ? "\n" : ",\n") << "  {\"module\": \"" << t.module << "\", \"signal\": \"" << t.signal
         << "\", \"situation\": \"" << t.situation << "\", \"speed\": " << text_of(t.speed)
         << ", \"back_s\": " << number(t.back_s) << ", \"stood_s\": " << number(t.stood_s)
         << ", \"contacts\": " << t.contacts << ", \"went_on_s\": " << number(t.went_on_s) << ", \"fault\": \""
         << t.fault << "\"}";
  }
  file << "],\n \"report\": " << evaluation::to_json(report, std::nullopt) << "}\n";
  file.close();
  std::filesystem::rename(path + ".part", path);
}

int run(const Options& options) {
  auto museum = museum::load_museum(options.museum);
  if (!museum) {
    std::fprintf(stderr, "%s\n", museum.error().message.c_str());
    return 2;
  }
  KillTrials robot{options, std::move(*museum)};
  if (!robot.begin()) return 1;
  std::printf(
      "| module    | hit  | while      |   m/s | back s | stood | contacts | went on | verdict |\n"
      "|-----------|------|------------|-------|--------|-------|----------|---------|---------|\n");
  std::vector<KillTrial> trials;
  std::map<std::string, std::vector<double>> backs;
  bool is_good = true;
  std::vector<std::string> modules;
  for (const auto& module : options.modules) {
    if (robot.has(module)) {
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
        trials.push_back(robot.run(module, signal, situation));
        print_row(trials.back());
        is_good = is_good && trials.back().fault.empty();
        if (signal == "kill") backs[module].push_back(trials.back().back_s.value_or(99.0));
      }
    }
  }
  const evaluation::DeploymentReport report = robot.report();
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
  if (!is_good) std::printf("\nwhat the robot said:\n%s\n", robot.log().c_str());
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
