#include "docent/apps/ros/ros_command.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>

#include "docent/apps/ros/ros_check.h"
#include "docent/apps/ros/ros_report.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/collision_avoidance/avoider/avoider_params.h"
#include "docent/messages/topics.h"
#include "docent/modules/drive/robot_module.h"
#include "docent/modules/eyes/eye_places.h"
#include "docent/transport/create3_support.h"
#include "docent/transport/dds_bus.h"

namespace docent::apps::ros {
namespace {

struct Options {
  Deployment deployment;
  double seconds = 3.0;  ///< [s] that it listens: time enough for a battery that speaks once a second
  bool json = false;
};

/// Counts what comes on each of the needs' topics.
template <class T>
void count(transport::DdsBus& bus, const Topic<T>& topic, std::map<std::string, Arrivals>& arrivals) {
  bus.subscribe<T>(topic, [&of = arrivals[topic.name]](const T&) { ++of.messages; });
}

void listen(transport::DdsBus& bus, const std::vector<Need>& needs, double duration_s,
            std::map<std::string, Arrivals>& arrivals) {
  for_each_robot_topic([&](const auto& topic) {
    for (const Need& need : needs)
      if (std::string_view{need.topic.name} == topic.name) count(bus, topic, arrivals);
  });
  for (const Need& need : needs)
    if (std::string_view{need.topic.name} == topics::kHazards.name) count(bus, topics::kHazards, arrivals);
  std::stop_source stop;
  bus.after(seconds(duration_s), [&stop] { stop.request_stop(); });
  bus.run(stop.get_token());
  for (const auto& [topic, refusals] : bus.refusals()) {
    arrivals[topic].refused = refusals.count;
    arrivals[topic].refusal = refusals.last.text();
  }
}

void check(const Options& options) {
  const Deployment& deployment = options.deployment;
  const robot::RobotConfig config = value_or_fail(deployment.load_config(), 2);
  const auto avoid = value_or_fail(config.section<collision_avoidance::AvoiderParams>("avoid"), 2);
  Check result;
  result.reach = transport::dds_reach(deployment.domain, deployment.interface);
  result.interfaces = transport::network_interfaces();
  result.notes = transport::environment_notes(result.reach, [](const char* name) { return std::getenv(name); });
  result.lines = deployment.ros_lines();
  result.seconds = options.seconds;
  const auto bus =
      value_or_fail(transport::DdsBus::create(deployment.bus_options(deployment.domain, "ros_check", config.body())));
  const Eyes eyes{value_or_fail(config.section<modules::SightParams>("sight"), 2).enabled,
                  value_or_fail(config.section<modules::CeilingParams>("ceiling"), 2).enabled};
  const auto needs =
      needs_of(config.body(), avoid.needs_sonar, value_or_fail(modules::base_is_create3(config), 2), eyes);
  std::map<std::string, Arrivals> arrivals;
  transport::RosNodeListener nodes{bus->participant()};
  listen(*bus, needs, options.seconds, arrivals);
  result.heard = transport::discovered(bus->participant());
  result.nodes = nodes.heard();
  const Wire wire{[&](const auto& topic) { return bus->wire_name(topic); },
                  [&](const auto& topic) { return bus->wire_type(topic); }};
  for (const Need& need : needs)
    result.findings.push_back(finding_of(need, arrivals[need.topic.name], options.seconds, wire, result.heard));
  check_commands(result, wire);
  check_others(result, wire);
  const std::string health = bus->wire_name(transport::topic_info(topics::kHealth));
  std::fputs((options.json ? json_of(result, health) : text_of(result, health)).c_str(), stdout);
  if (!result.is_fine()) throw CommandFailed{"", 1};
}

}  // namespace

void add_ros_command(CLI::App& app) {
  CLI::App* ros = app.add_subcommand("ros", "See how the robot reaches ROS 2, and what it lacks");
  ros->require_subcommand(1);
  CLI::App* command = ros->add_subcommand(
      "check", "Settings, who is heard, what is missing for each module; fails where something needed is missing");
  auto options = std::make_shared<Options>();
  options->deployment.add_robot_options(*command);
  options->deployment.add_bus_options(*command);
  command->add_option("--seconds", options->seconds, "How long it listens [s]")
      ->check(CLI::Range(0.5, 600.0))
      ->capture_default_str();
  command->add_flag("--json", options->json, "All of it for a program");
  command->callback([options] { check(*options); });
}

}  // namespace docent::apps::ros
