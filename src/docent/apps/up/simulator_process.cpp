#include "docent/apps/up/simulator_process.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <thread>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/log.h"
#include "docent/apps/shared/simulated_hardware.h"
#include "docent/modules/drive/base_mounts.h"
#include "docent/modules/perception/localize_module.h"
#include "docent/simulator/simulated_museum.h"
#include "docent/transport/dds_bus.h"

namespace docent::apps::up_command {
namespace {

/// What is simulated, and where its charger stands.
struct SimulatedPlace {
  std::filesystem::path file;  ///< simulation.yaml
  std::string name;
  std::optional<Point2> charger;
};

/// The robot's museum, or another place of which it knows nothing.
Result<SimulatedPlace> place_of(const Deployment& deployment, const std::string& world) {
  std::error_code ignored;
  if (std::filesystem::is_regular_file(world, ignored))
    return SimulatedPlace{world, std::filesystem::path{world}.stem().string(), std::nullopt};
  const auto museum = world.empty() ? deployment.load() : museum::load_museum(world);
  if (!museum) return tl::unexpected<Error>(museum.error());
  if (!museum->simulation_path) return fail(museum->folder.string() + ": the museum has no simulation");
  SimulatedPlace place{*museum->simulation_path, museum->folder.filename().string(), std::nullopt};
  if (museum->charger) place.charger = museum->charger->position();
  return place;
}

Result<simulator::SimulationOptions> simulation_of(const Deployment& deployment, const SimulatorOptions& options) {
  auto place = place_of(deployment, options.world);
  if (!place) return tl::unexpected<Error>(place.error());
  auto config = deployment.load_config();
  if (!config) return tl::unexpected<Error>(config.error());
  auto world = simulator::load_world(place->file);
  if (!world) return tl::unexpected<Error>(world.error());
  simulator::SimulationOptions simulation;
  simulation.world = std::move(*world);
  simulation.hardware = simulated_hardware(config->body());
  simulation.seed = deployment.seed;
  simulation.crowd = options.crowd;
  simulation.bodies = simulator::bodies_of(options.bodies);
  if (!simulation.bodies) return fail("--bodies " + options.bodies + ": legs or discs");
  if (options.heedless > 0.0) simulation.heedless = options.heedless;
  const std::string option = options.start.empty() ? "--explore" : "--start";
  const std::string& start = options.start.empty() ? deployment.explore : options.start;
  if (!start.empty()) {
    simulation.start = parse_pose(option, start);
    if (!contains(simulation.world.operating_area, simulation.start->position())) {
      return fail(option + " " + start + ": outside the robot's area");
    }
  }
  auto eyes = simulated_eyes(*config);
  if (!eyes) return tl::unexpected<Error>(eyes.error());
  if (options.has_cameras || eyes->up || eyes->depth || eyes->front)
    simulation.cameras = simulator::CameraOptions{.for_people = options.has_cameras, .eyes = *eyes};
  simulation.charger = place->charger;
  if (options.requests_per_hour >= 0.0) simulation.requests_per_hour = options.requests_per_hour;
  if (!options.scenario.empty()) {
    auto scenario = simulator::load_scenario(options.scenario);
    if (!scenario) return tl::unexpected<Error>(scenario.error());
    if (auto built = build_wrongly(simulation.hardware, scenario->build); !built)
      return tl::unexpected<Error>(built.error());
    if (simulation.start) simulation.start = *simulation.start * scenario->build.start;
    simulation.scenario = std::move(*scenario);
  }
  simulation.run_info.museum = place->name;
  simulation.run_info.mode = options.mode;
  simulation.run_info.config_hash = config->hash();
  auto simd = modules::simd_of_localize(*config);
  if (!simd) return tl::unexpected<Error>(simd.error());
  simulation.run_info.simd = *simd;
  if (auto valid = validate(simulation); !valid) return tl::unexpected<Error>(valid.error());
  return simulation;
}

}  // namespace

void SimulatorOptions::add_options(CLI::App& command) {
  command.add_option("--crowd", crowd, "Simulated visitors")
      ->check(CLI::IsMember({"empty", "quiet", "busy", "packed"}))
      ->capture_default_str();
  command.add_option("--bodies", bodies, "What people are made of: legs that walk, or discs to the floor")
      ->check(CLI::IsMember({"legs", "discs"}))
      ->capture_default_str();
  command
      .add_option("--heedless", heedless,
                  "Share of people who do not evade: children who run, backs turned, a phone in hand")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.add_option("--start", start, "Where the simulated robot wakes up: X,Y,DEG; without it somewhere");
  command.add_option(
      "--world", world,
      "What is simulated: folder of a museum, or a file simulation.yaml; without it the robot's own museum");
  command.add_option("--scenario", scenario, "Scenario file for the simulator");
  command.add_flag("!--no-cameras", has_cameras, "Simulate no camera: saves a tenth of a processor");
  command.add_option("--mode", mode, "One of the museum's modes, or hours: what the museum's hours say")
      ->capture_default_str();
  command.add_option("--requests-per-hour", requests_per_hour, "Of simulated visitors; without it as the museum says")
      ->check(CLI::Range(0.0, 10000.0));
}

std::vector<std::string> SimulatorOptions::arguments() const {
  std::vector<std::string> all{"--crowd", crowd, "--mode", mode, "--bodies", bodies};
  if (heedless > 0.0) all.insert(all.end(), {"--heedless", std::to_string(heedless)});
  if (!world.empty()) all.insert(all.end(), {"--world", world});
  if (!start.empty()) all.insert(all.end(), {"--start=" + start});  // it may begin with a minus
  if (!has_cameras) all.emplace_back("--no-cameras");
  if (!scenario.empty()) all.insert(all.end(), {"--scenario", scenario});
  if (requests_per_hour >= 0.0) all.insert(all.end(), {"--requests-per-hour", std::to_string(requests_per_hour)});
  return all;
}

Result<void> check_simulator(const Deployment& deployment, const SimulatorOptions& options) {
  auto simulation = simulation_of(deployment, options);
  if (!simulation) return tl::unexpected<Error>(simulation.error());
  return {};
}

Result<void> run_simulator(const Deployment& deployment, const SimulatorOptions& options) {
  auto simulation = simulation_of(deployment, options);
  if (!simulation) return tl::unexpected<Error>(simulation.error());
  const auto warn = [](const std::string& text) { log_to_stderr(LogLevel::warning, kSimulatorProcess, text); };
  block_end_signals();
  const auto config = deployment.load_config();
  if (!config) return tl::unexpected<Error>(config.error());
  const auto bus_in = [&](int domain) {
    transport::DdsOptions dds = deployment.bus_options(domain, kSimulatorProcess, config->body());
    dds.warn = warn;
    return transport::DdsBus::create(std::move(dds));
  };
  auto robot_bus = bus_in(deployment.domain);
  if (!robot_bus) return tl::unexpected<Error>(robot_bus.error());
  auto truth_bus = bus_in(transport::truth_domain(deployment.domain));
  if (!truth_bus) return tl::unexpected<Error>(truth_bus.error());
  // As the model of a base says where its scanners are, if robot.yaml does not.
  if (modules::wants_mounts_of_base(config->body()))
    (*robot_bus)->publisher(topics::kStaticTransforms).publish(modules::BaseMounts{config->body()}.transforms(true));
  const simulator::SimulatedMuseum museum{**robot_bus, **truth_bus, std::move(*simulation)};
  const std::jthread truth_thread{[&truth_bus](const std::stop_token& stop) { (*truth_bus)->run(stop); }};
  (*robot_bus)->run(end_signal());
  return {};
}

}  // namespace docent::apps::up_command
