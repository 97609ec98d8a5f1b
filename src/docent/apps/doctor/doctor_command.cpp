#include "docent/apps/doctor/doctor_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stop_token>

#include "docent/apps/doctor/computer.h"
#include "docent/apps/doctor/findings.h"
#include "docent/apps/doctor/sensors.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/grid/map_classes.h"
#include "docent/modules/drive/plan_module.h"
#include "docent/modules/drive/robot_module.h"
#include "docent/museum/heading_notes.h"
#include "docent/robot/body_notes.h"
#include "docent/task_control/golex/executive_params.h"
#include "docent/transport/dds_bus.h"

namespace docent::apps::doctor_command {
namespace {

constexpr std::size_t kMostFaults = 5;  // of a museum that are shown; `docent check` has all

struct Options {
  Deployment deployment;
  double listen_s = 6.0;
  int port = 8080;
  bool as_json = false;
};

std::string shown(const std::string& path) { return path.empty() ? "all defaults" : path; }

/// What is written down. @returns the configuration, unless it is at fault
std::optional<robot::RobotConfig> look_at_files(const Options& options, std::vector<Finding>& all) {
  auto config = options.deployment.load_config();
  if (!config) {
    all.push_back({"files", "robot.yaml", Verdict::wrong, config.error().message});
    return std::nullopt;
  }
  const auto notes = robot::body_notes(config->body());
  if (notes.empty()) all.push_back({"files", "robot.yaml", Verdict::fine, shown(options.deployment.robot)});
  for (const std::string& note : notes) all.push_back({"files", "robot.yaml", Verdict::note, note});
  const auto robot = modules::checked_robot_of_plan(*config);
  if (!robot) {
    all.push_back({"files", "robot.yaml", Verdict::wrong, robot.error().message});
    return std::nullopt;
  }
  const std::vector<Error> faults = museum::check_museum(options.deployment.museum, *robot);
  for (std::size_t i = 0; i < faults.size() && i < kMostFaults; ++i)
    all.push_back({"files", "museum", Verdict::wrong, faults[i].message});
  if (faults.size() > kMostFaults)
    all.push_back({"files", "museum", Verdict::wrong,
                   "and " + std::to_string(faults.size() - kMostFaults) + " more: docent check"});
  if (!faults.empty()) return std::move(*config);
  const auto museum = museum::load_museum(options.deployment.museum);
  if (!museum) {
    all.push_back({"files", "museum", Verdict::wrong, museum.error().message});
    return std::move(*config);
  }
  const GridFrame& frame = museum->map.frame;
  char text[160];
  std::snprintf(text, sizeof text, "%s: %zu exhibits, %zu hazards, map %.1f x %.1f m%s",
                options.deployment.museum.c_str(), museum->exhibits.size(), museum->hazards.size(),
                frame.columns * frame.resolution, frame.rows * frame.resolution, museum->charger ? "" : ", no charger");
  all.push_back({"files", "museum", Verdict::fine, text});
  const MapClasses classes = classes_of(museum->map);
  all.push_back({"files", "map", Verdict::fine, "was read as " + classes.text()});
  if (const std::string warning = classes.warning(); !warning.empty())
    all.push_back({"files", "map", Verdict::note, warning});
  for (const std::string& note : museum->map_notes) all.push_back({"files", "map", Verdict::note, note});
  for (const std::string& note : museum::heading_notes(*museum))
    all.push_back({"files", "museum", Verdict::note, note});
  return std::move(*config);
}

BaseKind kind_of(const robot::RobotConfig& config) {
  BaseKind kind;
  kind.is_create3 = value_or_fail(modules::base_is_create3(config), 2);
  kind.docks_by_action = value_or_fail(config.section<task_control::ExecutiveParams>("executive"), 2).docking.by_action;
  return kind;
}

void examine(const Options& options) {
  std::vector<Finding> all;
  const auto config = look_at_files(options, all);
  if (config) {
    const Deployment& deployment = options.deployment;
    transport::DdsOptions dds = deployment.bus_options(deployment.domain, "doctor", config->body());
    std::vector<std::string> warnings;
    dds.warn = [&warnings](const std::string& text) { warnings.push_back(text); };
    auto bus = value_or_fail(transport::DdsBus::create(std::move(dds)));
    Sensors sensors{*bus, config->body(), kind_of(*config)};
    if (!options.as_json) std::fprintf(stderr, "listening for %.0f s\n", options.listen_s);
    std::stop_source stop;
    const Time begin = bus->now();
    std::vector<Finding> heard;
    bus->after(seconds(options.listen_s), [&] {
      heard = sensors.findings(begin);
      stop.request_stop();
    });
    bus->run(stop.get_token());
    all.insert(all.end(), heard.begin(), heard.end());
    for (const std::string& warning : warnings) all.push_back({"base", "DDS", Verdict::wrong, warning});
    ComputerDemand demand;
    demand.state = options.deployment.state;
    demand.port = options.port;
    demand.robot_runs = sensors.robot_runs();
    demand.processes = value_or_fail(config->section<modules::ProcessParams>(modules::kProcesses), 2);
    demand.web = value_or_fail(config->section<modules::WebParams>("web"), 2);
    for (Finding& finding : findings_of_computer(demand)) all.push_back(std::move(finding));
  }
  std::fputs((options.as_json ? json_of(all) : page_of(all)).c_str(), stdout);
  std::fflush(stdout);
  if (worst_of(all) == Verdict::wrong) throw CommandFailed{"", 1};
}

}  // namespace

void add_doctor_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "doctor", "Show on one page whether all arrives that the robot needs, before a motor turns; exits with 1 if not");
  options->deployment.add_options(*command);
  command->add_option("--port", options->port, "Port of the page")->check(CLI::Range(1, 65535))->capture_default_str();
  command->add_option("--listen", options->listen_s, "Seconds")->check(CLI::Range(1.0, 600.0))->capture_default_str();
  command->add_flag("--json", options->as_json, "For programs");
  command->callback([options] { examine(*options); });
}

}  // namespace docent::apps::doctor_command
