#include "docent/apps/up/run_command.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <thread>

#include "docent/apps/shared/cache_folder.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/apps/shared/log.h"
#include "docent/apps/shared/robot_maker.h"
#include "docent/apps/up/simulator_process.h"
#include "docent/apps/up/supervisor.h"
#include "docent/modules/host/module_host.h"
#include "docent/modules/host/process_class.h"
#include "docent/transport/dds_bus.h"

namespace docent::apps::up_command {
namespace {

struct RunOptions {
  Deployment deployment;
  SimulatorOptions simulator;
  std::string module;
};

std::string module_names() {
  std::string names;
  for (const auto& entry : modules::all_modules()) names += std::string{entry.name} + ", ";
  return names + kSimulatorProcess;
}

std::unique_ptr<transport::DdsBus> join(const Deployment& deployment, int domain, const std::string& module) {
  transport::DdsOptions options{domain, deployment.name, {}};
  options.warn = [module](const std::string& text) { log_to_stderr(LogLevel::warning, module, text); };
  options.interface = deployment.interface;
  options.stamped_commands = value_or_fail(deployment.load_config(), kExitBadConfiguration).body().stamped_commands;
  return value_or_fail(transport::DdsBus::create(std::move(options)));
}

void run(const RunOptions& options, RobotMaker& maker) {
  if (options.module == kSimulatorProcess) {
    return value_or_fail(run_simulator(options.deployment, options.simulator), kExitBadConfiguration);
  }
  const modules::ModuleEntry* entry = modules::find_module(options.module);
  if (entry == nullptr) {
    throw CommandFailed{"no module '" + options.module + "'; there are " + module_names(), kExitBadConfiguration};
  }
  const Deployment& deployment = options.deployment;
  const museum::Museum museum = value_or_fail(deployment.load(), kExitBadConfiguration);
  robot::RobotConfig config = value_or_fail(deployment.load_config(maker.sections()), kExitBadConfiguration);
  value_or_fail(maker.read(config), kExitBadConfiguration);
  value_or_fail(deployment.prepare_state(), kExitBadConfiguration);
  if (entry->keeps_cache) prepare_cache(deployment.cache);

  const auto classes =
      value_or_fail(config.section<modules::ProcessParams>(modules::kProcesses), kExitBadConfiguration);
  block_end_signals();
  // Before the bus: its threads take the class over.
  const std::string handicap = entry->is_urgent ? modules::enter_process_class(classes) : std::string{};
  auto dds_bus = join(deployment, deployment.domain, options.module);
  transport::DdsBus& bus = *dds_bus;
  const auto truth =
      entry->sees_truth ? join(deployment, transport::truth_domain(deployment.domain), options.module) : nullptr;
  modules::ModuleHost::Options host_options;
  host_options.state = deployment.state;
  host_options.cache = deployment.cache;
  host_options.is_setup = deployment.is_setup;
  host_options.seed = deployment.seed;
  host_options.pid = getpid();
  host_options.truth = truth.get();
  host_options.handicap = handicap;
  const auto host =
      value_or_fail(maker.make(*entry, std::move(dds_bus), museum, config, host_options), kExitBadConfiguration);
  const std::jthread truth_thread{[&truth](const std::stop_token& stop) {
    if (truth) truth->run(stop);
  }};
  bus.run(end_signal());
}

}  // namespace

void add_run_command(CLI::App& app, std::shared_ptr<RobotMaker> maker) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand("run", "Run one module as a process, perhaps on another computer");
  command->add_option("module", options->module, module_names())->required();
  options->deployment.add_options(*command);
  options->simulator.add_options(*command->add_option_group("For the simulator"));
  command->callback([options, maker = std::move(maker)] { run(*options, *maker); });
}

}  // namespace docent::apps::up_command
