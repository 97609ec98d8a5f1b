#include "docent/apps/up/robot_run.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/shared/deployment.h"
#include "docent/apps/shared/map_note.h"
#include "docent/apps/up/simulator_process.h"
#include "docent/apps/up/status_display.h"
#include "docent/apps/up/supervisor.h"
#include "docent/base/shipped_files.h"
#include "docent/modules/host/process_class.h"
#include "docent/modules/host/registry.h"
#include "docent/museum/day_plan.h"
#include "docent/museum/editing/museum_setup.h"
#include "docent/museum/editing/museum_workshop.h"
#include "docent/recording/join_recordings.h"
#include "docent/transport/dds_bus.h"
#include "docent/transport/discovery/discovery.h"

namespace docent::apps::up_command {
namespace {

constexpr Duration kStep = std::chrono::milliseconds{50};
constexpr Duration kShow = std::chrono::milliseconds{500};
constexpr Duration kLookRound = std::chrono::seconds{1};  // a round of discovery: SPDPInterval
constexpr int kMostRounds = 4;                            // until one that was told to end has ended
constexpr int kUrgent = -10;                              // nice values: of those on which braking waits,
constexpr int kPrompt = -5;                               // and driving;
constexpr int kStepBack = 5;                              // of the others, where nobody may be put in front
constexpr double kInterfacePatience = 60.0;  // [s] then systemd tries again, without counting it as dying at once
constexpr double kInterfaceStep = 0.5;       // [s]
constexpr double kPatience = 5.0;            // [s] for the modules to end in order

std::filesystem::path recordings_folder(const RobotRun& options) {
  return std::filesystem::path{options.deployment.state} / "recordings";
}

Result<void> check_port(int port) {
  const int end = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  setsockopt(end, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);  // as the web server does
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const bool is_free = bind(end, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  const std::string why = std::strerror(errno);
  close(end);
  if (!is_free) return fail("--port " + std::to_string(port) + ": " + why);
  return {};
}

bool may_raise_priority() {
  const int before = getpriority(PRIO_PROCESS, 0);
  if (setpriority(PRIO_PROCESS, 0, before + kUrgent) != 0) return false;
  setpriority(PRIO_PROCESS, 0, before);
  return true;
}

int niceness_of(const modules::ModuleEntry& entry, bool may_raise) {
  if (!entry.is_urgent && !entry.is_prompt) return may_raise ? 0 : kStepBack;
  if (!may_raise) return 0;
  return entry.is_urgent ? kUrgent : kPrompt;
}

/// Mode and speed limit, as the museum's staff would set them in the morning.
Result<docent_msgs::Limits> limits_of(const RobotRun& options, const museum::Museum& museum,
                                      const robot::RobotConfig& config) {
  docent_msgs::Limits limits;
  limits.mode = options.simulator.mode;
  limits.max_speed = config.body().max_speed;
  const auto mode = museum.modes.find(limits.mode);
  if (mode != museum.modes.end()) {
    limits.max_speed = std::min(limits.max_speed, mode->second.max_speed);
  } else if (limits.mode != "open" && limits.mode != "hours") {
    return fail("--mode " + limits.mode + ": the museum has no such mode" + museum::mode_meant(limits.mode));
  }
  return limits;
}

/// Everything that can be known to be wrong before a process is started.
docent_msgs::Limits check(const RobotRun& options) {
  const museum::Museum museum = value_or_fail(options.deployment.load(reading_of(options.deployment.museum)));
  const robot::RobotConfig config = value_or_fail(options.deployment.load_config());
  std::vector<std::string> sections;
  for (const auto& entry : modules::all_modules()) sections.emplace_back(entry.name);
  sections.emplace_back(modules::kProcesses);
  value_or_fail(config.check_sections(sections));
  if (options.simulate) value_or_fail(check_simulator(options.deployment, options.simulator));
  docent_msgs::Limits limits = value_or_fail(limits_of(options, museum, config));
  value_or_fail(check_port(options.port));
  value_or_fail(own_state(options.deployment));
  if (!options.deployment.is_exploring()) say_map(museum);
  return limits;
}

/// What all processes are told.
/// @param museum  the folder in which they work
Result<Deployment> told_to_all(const RobotRun& options, const std::string& museum) {
  Deployment told = options.deployment;
  told.museum = museum;
  told.settings.push_back("web.port=" + std::to_string(options.port));
  if (!options.record.empty()) {
    told.settings.push_back("record.keep_files=10000");  // all of this run are needed at its end
  }
  if (!told.is_setup) return told;
  const auto progress = museum::MuseumSetup::read(options.deployment.museum);
  if (!progress) return tl::unexpected<Error>(progress.error());
  if (museum::work_of(progress->step) == museum::SetupWork::map) {
    told.explore = pose_text(progress->start);
    told.settings.emplace_back("explore.waits_for_order=true");
  }
  return told;
}

/// All processes of the robot, in the order in which they are started.
Result<std::vector<ChildSpec>> children_of(const RobotRun& options, const std::string& museum) {
  const auto told = told_to_all(options, museum);
  if (!told) return tl::unexpected<Error>(told.error());
  const auto work = told->work();
  if (!work) return tl::unexpected<Error>(work.error());
  const std::string program = program_path().string();
  const auto command = [&](const std::string& name) {
    std::vector<std::string> words{program, "run", name};
    const auto arguments = told->arguments();
    words.insert(words.end(), arguments.begin(), arguments.end());
    return words;
  };
  std::vector<ChildSpec> children;
  // Where nobody may be put in front, the others step back.
  const bool may_raise = may_raise_priority();
  if (options.simulate) {
    // It stands for hardware, which no other program holds up.
    auto words = command(kSimulatorProcess);
    const auto more = options.simulator.arguments();
    words.insert(words.end(), more.begin(), more.end());
    children.push_back({kSimulatorProcess, std::move(words), may_raise ? kUrgent : 0, false});
  }
  for (const auto& entry : modules::all_modules()) {
    if (!modules::runs(entry, *work)) continue;
    children.push_back({entry.name, command(entry.name), niceness_of(entry, may_raise), true});
  }
  return children;
}

/// What was recorded since `before`, as one file.
Result<void> keep_recording(const RobotRun& options, const std::set<std::filesystem::path>& before) {
  const auto all = recording::recordings_in(recordings_folder(options));
  std::vector<std::filesystem::path> files;
  std::set_difference(all.begin(), all.end(), before.begin(), before.end(), std::back_inserter(files));
  return recording::join_recordings(files, options.record);
}

/// For whoever stands beside it; empty: nothing new.
std::string told_of(const docent_msgs::Exploration& now, const std::string& state_before) {
  if (now.state == state_before) return {};
  if (now.state != "done" && now.state != "stranded") return now.state;
  char text[120];
  std::snprintf(text, sizeof text, "%s: %.0f m2 after %.0f m, %zu places not reached or not seen into; ",
                now.state.c_str(), static_cast<double>(now.known_m2), static_cast<double>(now.way_m),
                now.unreached_x.size());
  return text + now.map + (now.warning.empty() ? "" : "; do not trust it: " + now.warning);
}

void tell_exploration(transport::Bus& bus, StatusDisplay& display) {
  auto state = std::make_shared<std::string>();
  bus.subscribe<docent_msgs::Exploration>(topics::kExploration, [state, &display](const docent_msgs::Exploration& now) {
    if (const std::string told = told_of(now, *state); !told.empty()) display.log(LogLevel::info, "explore", told);
    *state = now.state;
  });
}

void tell_reach(const Deployment& deployment, StatusDisplay& display) {
  const auto reach = transport::dds_reach(deployment.domain, deployment.interface);
  display.log(LogLevel::info, "bus", in_words(reach));
  for (const auto& line : deployment.ros_lines())
    display.log(LogLevel::info, "bus", "for ROS 2 (" + line.implementation + "): " + line.line);
  for (const std::string& note :
       transport::environment_notes(reach, [](const char* name) { return std::getenv(name); }))
    display.log(LogLevel::warning, "bus", note);
}

/// Before any module runs: two robots of one name would each obey the other's sensors and drive the other's base. One
/// that is just ending gets some time for it; one that was killed does not count, for its writers no longer live.
void look_for_others(transport::DdsBus& bus, const Deployment& deployment, StatusDisplay& display) {
  const auto command = transport::topic_info(topics::kCommandVelocity);
  const std::string health = bus.wire_name(transport::topic_info(topics::kHealth));
  int commanders = bus.other_writers(command);  // from now on it is watched whether they live
  bool is_robot = true;
  for (int round = 0; round < kMostRounds && is_robot; ++round) {
    std::stop_source stop;
    bus.after(kLookRound, [&stop] { stop.request_stop(); });
    bus.run(stop.get_token());
    commanders = bus.other_writers(command);
    is_robot = commanders > 0 && has_robot(transport::discovered(bus.participant()), health, bus.wire_name(command));
  }
  const std::string domain = "domain " + std::to_string(deployment.domain);
  if (is_robot)
    throw CommandFailed{"another robot " +
                        (deployment.name.empty() ? std::string{"without a name"} : "named '" + deployment.name + "'") +
                        " is on " + domain +
                        ": both would drive both bases. Give this one a --name or a --domain of its own"};
  if (commanders > 0)
    display.log(LogLevel::warning, "bus",
                (commanders == 1 ? std::string{"another program publishes"}
                                 : std::to_string(commanders) + " other programs publish") +
                    " cmd_vel on " + domain + ": the base obeys whoever spoke last; `docent ros check` names them");
}

/// A computer may start before its network does: the interface gets time to come up.
void await_interface(const Deployment& deployment, StatusDisplay& display) {
  if (!transport::dds_reach(deployment.domain, deployment.interface).uri.empty()) return;
  const auto look = [&] { return transport::check_interface(deployment.interface, transport::network_interfaces()); };
  auto there = look();
  if (there) return;
  display.log(LogLevel::warning, "bus", there.error().message + ": waiting for it");
  for (double waited = 0.0; !there && waited < kInterfacePatience; waited += kInterfaceStep) {
    if (wait_for_end_signal(kInterfaceStep) != 0) throw CommandFailed{"", 0};
    there = look();
  }
}

std::unique_ptr<transport::DdsBus> join(const Deployment& deployment, StatusDisplay& display) {
  await_interface(deployment, display);
  const auto config = value_or_fail(deployment.load_config(), kExitBadConfiguration);
  transport::DdsOptions options = deployment.bus_options(deployment.domain, "up", config.body());
  options.warn = [&display](const std::string& text) { display.log(LogLevel::warning, "bus", text); };
  auto bus = value_or_fail(transport::DdsBus::create(std::move(options)));
  look_for_others(*bus, deployment, display);
  tell_reach(deployment, display);
  return bus;
}

}  // namespace

Result<void> own_state(const Deployment& deployment) {
  static int held = -1;  // until the process ends
  if (held >= 0) return {};
  if (auto made = deployment.prepare_state(); !made) return made;
  const std::string path = deployment.state + "/up.lock";
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file < 0) return fail(path + ": " + std::strerror(errno));
  if (flock(file, LOCK_EX | LOCK_NB) != 0) {
    close(file);
    return fail("--state " + deployment.state + ": another `docent up` works there");
  }
  held = file;
  return {};
}

void run_robot(const RobotRun& options) {
  const docent_msgs::Limits limits = check(options);
  const auto recorded_before = recording::recordings_in(recordings_folder(options));
  block_end_signals();
  const auto print = [](const std::string& text) {
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
  };
  StatusDisplay display{isatty(STDOUT_FILENO) == 1, print, StatusDisplay::Clock::now()};
  const auto log = [&](Supervisor::From from, const std::string& name, const std::string& line) {
    if (from == Supervisor::From::child) return display.log_output(name, line);
    display.log(LogLevel::error, name, line);
  };
  const auto bus = join(options.deployment, display);
  Supervisor supervisor{value_or_fail(children_of(options, options.deployment.museum)), log};
  bus->publisher(topics::kLimits).publish(limits);
  bool is_announced = false;
  bus->subscribe<docent_msgs::Health>(topics::kHealth, [&](const docent_msgs::Health& health) {
    supervisor.heard(health.module, health.pid, health.state, health.reason);
    if (!is_announced && health.module == "web" && health.state != "starting") {
      is_announced = true;
      display.log(LogLevel::info, "web", "open http://127.0.0.1:" + std::to_string(options.port) + options.page);
    }
  });
  tell_exploration(*bus, display);
  bus->subscribe<docent_msgs::MuseumMoved>(topics::kMuseumMoved, [&](const docent_msgs::MuseumMoved& moved) {
    const std::string trial = museum::trial_folder(options.deployment.state).string();
    const std::string& folder = moved.is_trial ? trial : options.deployment.museum;
    // Whoever sends this: where nothing can work, all would be lost.
    const auto stage = options.deployment.is_setup ? museum::Stage::being_set_up : museum::Stage::complete;
    if (const auto known = museum::load_museum(folder, stage); !known)
      return display.log(LogLevel::error, "museum", known.error().message);
    const auto children = children_of(options, folder);
    if (!children) return display.log(LogLevel::error, "museum", children.error().message);
    display.log(LogLevel::info, "museum", moved.is_trial ? "the robot tries a draft" : "the museum is read again");
    // The simulated world stays as it is: people change what the robot knows of it.
    supervisor.replace(*children, kSimulatorProcess);
  });
  std::stop_source stop;
  bus->every(kStep, [&] {
    supervisor.step();
    if (supervisor.fatal() || wait_for_end_signal(0.0) != 0) stop.request_stop();
  });
  bus->every(kShow, [&] { display.show(supervisor.status(), StatusDisplay::Clock::now()); });
  bus->run(stop.get_token());
  display.show(supervisor.status(), StatusDisplay::Clock::now());
  display.finish();
  supervisor.stop(kPatience);
  if (supervisor.fatal()) {
    const std::string own_name = "docent: ";
    const std::string& line = *supervisor.fatal();
    throw CommandFailed{line.starts_with(own_name) ? line.substr(own_name.size()) : line, kExitBadConfiguration};
  }
  if (!options.record.empty()) {
    value_or_fail(keep_recording(options, recorded_before));
    display.log(LogLevel::info, "record", "the recording is " + options.record);
  }
}

}  // namespace docent::apps::up_command
