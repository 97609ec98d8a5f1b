#include "docent/apps/shared/deployment.h"

#include <signal.h>
#include <sys/stat.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <system_error>
#include <thread>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/cache_folder.h"
#include "docent/base/shipped_files.h"
#include "docent/messages/topics.h"
#include "docent/modules/host/process_class.h"
#include "docent/modules/host/registry.h"
#include "docent/museum/blank_museum.h"
#include "docent/museum/museum_loading.h"
#include "docent/transport/dds_bus.h"

namespace docent::apps {

namespace {
constexpr const char* kCrippling = "evaluation";  ///< the section that docent-lab reads
constexpr const char* kOnlyInTheLaboratory = "cripples the robot, which docent-lab alone does, in simulations";

/// That no scanner is said to speak where other messages go.
Result<void> scanners_have_free_topics(const robot::RobotBody& body) {
  Result<void> right;
  for (const robot::Scanner& scanner : body.scanners) {
    std::string topic = body.topic_of(scanner);
    if (topic.starts_with('/')) topic.erase(0, 1);
    for_each_robot_topic([&](const auto& other) {
      const std::string type = transport::topic_info(other).type->name;
      if (topic == other.name && type != sensor_msgs::LaserScan::kType)
        right = fail("body.scanners: " + scanner.name + " cannot speak on " + topic + ", where messages are " + type);
    });
  }
  return right;
}
}  // namespace

void Deployment::add_options(CLI::App& command, Museum named) {
  state = default_state();
  if (named == Museum::is_option) {
    museum = default_museum();
    command.add_option("--museum", museum, "Folder of the museum")->capture_default_str();
  }
  command.add_option("--state", state, "Folder for what must survive: checkpoints, databases")
      ->check(kept_folder())
      ->capture_default_str();
  add_cache_options(command, cache);
  add_robot_options(command);
  add_bus_options(command);
  add_seed(command, "--seed", seed, "Seed of everything random");
  command
      .add_option("--explore", explore,
                  "X,Y,DEG: where the robot begins to map the museum by itself, in the frame of its hazards and area; "
                  "its map, exhibits and tours are not used")
      ->check(pose_option());
  command.add_flag("--setup", is_setup)->group("");  // how docent setup tells its modules
}

void Deployment::add_robot_options(CLI::App& command) {
  command.add_option("--robot", robot, "robot.yaml of the robot; without it all defaults");
  command.add_option("--set", settings, "section.key=value, over robot.yaml; may be repeated")->allow_extra_args(false);
}

void Deployment::add_bus_options(CLI::App& command) {
  command.add_option("--name", name, "Prefix of the topics, where several robots share a domain")
      ->check(topic_prefix());
  command.add_option("--domain", domain, "DDS domain")
      ->check(CLI::Range(0, transport::kMaxDdsDomain))
      ->capture_default_str();
  command
      .add_option("--interface", interface,
                  "Network interface that DDS hears beside loopback, such as eth0; lo: this computer only")
      ->capture_default_str();
}

std::vector<std::string> Deployment::arguments() const {
  std::vector<std::string> all{"--museum", museum, "--state", state};
  if (cache.empty()) {
    all.emplace_back("--no-cache");
  } else {
    all.insert(all.end(), {"--cache", cache});
  }
  if (!robot.empty()) all.insert(all.end(), {"--robot", robot});
  for (const auto& setting : settings) all.insert(all.end(), {"--set", setting});
  if (!name.empty()) all.insert(all.end(), {"--name", name});
  if (is_setup) all.emplace_back("--setup");
  if (!explore.empty()) all.insert(all.end(), {"--explore", explore});
  if (interface != transport::kLoopback) all.insert(all.end(), {"--interface", interface});
  all.insert(all.end(), {"--domain", std::to_string(domain), "--seed", std::to_string(seed)});
  return all;
}

Result<museum::Museum> Deployment::load(const ReadingProgress& progress) const {
  const auto stage = is_setup || is_exploring() ? museum::Stage::being_set_up : museum::Stage::complete;
  auto loaded = museum::load_museum(museum, stage, progress);
  if (!loaded || !is_exploring()) return loaded;
  return museum::without_map(*loaded, parse_pose("--explore", explore));
}

Result<museum::SetupWork> Deployment::work() const {
  if (is_exploring()) return museum::SetupWork::map;
  if (!is_setup) return museum::SetupWork::guide;
  const auto progress = museum::MuseumSetup::read(museum);
  if (!progress) return tl::unexpected<Error>(progress.error());
  return museum::work_of(progress->step);
}

Result<robot::RobotConfig> Deployment::load_config(const std::vector<std::string>& further) const {
  robot::RobotConfig config;
  if (!robot.empty()) {
    auto loaded = robot::RobotConfig::load(robot);
    if (!loaded) return loaded;
    config = std::move(*loaded);
  }
  for (const auto& setting : settings) {
    auto set = config.set(setting);
    if (!set) return tl::unexpected<Error>(set.error());
  }
  std::vector<std::string> sections = further;
  sections.emplace_back(modules::kProcesses);
  for (const modules::ModuleEntry& entry : modules::all_modules()) sections.emplace_back(entry.name);
  if (std::find(further.begin(), further.end(), kCrippling) == further.end()) {
    if (auto whole = config.refuse_section(kCrippling, kOnlyInTheLaboratory); !whole)
      return tl::unexpected<Error>(whole.error());
  }
  if (auto known = config.check_sections(sections); !known) return tl::unexpected<Error>(known.error());
  if (auto right = scanners_have_free_topics(config.body()); !right) return tl::unexpected<Error>(right.error());
  return config;
}

std::vector<transport::RosLine> Deployment::ros_lines() const {
  std::error_code error;
  const auto installed = shipped_path("dds");
  const auto files = std::filesystem::exists(installed, error) ? installed : shipped_path("share/dds");
  return transport::ros_lines(transport::dds_reach(domain, interface), files.string());
}

Result<void> Deployment::prepare_state() const {
  std::error_code error;
  std::filesystem::create_directories(state, error);
  if (error || !std::filesystem::is_directory(state)) {
    return fail("--state " + state + ": " + (error ? error.message() : "is not a folder"));
  }
  // What it holds, and what recordings show, is nobody else's.
  ::umask(0077);
  for (const auto& entry : std::filesystem::directory_iterator(state, error))
    if (entry.is_regular_file(error))
      std::filesystem::permissions(entry.path(), std::filesystem::perms::group_all | std::filesystem::perms::others_all,
                                   std::filesystem::perm_options::remove, error);
  return {};
}

std::string default_museum() { return shipped_path("museums/bonn").string(); }

std::string default_state() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state != '\0') return std::string{state} + "/docent";
  const char* home = std::getenv("HOME");
  return std::string{home != nullptr && *home != '\0' ? home : "/tmp"} + "/.local/state/docent";
}

transport::DdsOptions Deployment::bus_options(int dds_domain, const std::string& process,
                                              const robot::RobotBody& body) const {
  transport::DdsOptions options{dds_domain, name, {}};
  options.interface = interface;
  options.stamped_commands = body.stamped_commands;
  options.node = "docent_" + process;
  for (const robot::Scanner& scanner : body.scanners)
    options.renamed[topics::scan_topic(scanner.name).name] = body.topic_of(scanner);
  return options;
}

namespace {
sigset_t end_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&set, number);
  return set;
}
}  // namespace

void block_end_signals() {
  const sigset_t set = end_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signal(SIGPIPE, SIG_IGN);
}

int wait_for_end_signal(double timeout_s) {
  const sigset_t set = end_signals();
  int number = 0;
  if (timeout_s < 0) {
    sigwait(&set, &number);
  } else {
    const double whole = std::floor(timeout_s);
    const timespec timeout{static_cast<time_t>(whole), static_cast<long>((timeout_s - whole) * 1e9)};
    number = std::max(0, sigtimedwait(&set, nullptr, &timeout));
  }
  return number;
}

std::stop_token end_signal() {
  std::stop_source stop;
  // Detached, because it waits for what may never come; it owns what it touches.
  std::thread{[stop]() mutable {
    static_cast<void>(wait_for_end_signal(-1.0));
    stop.request_stop();
  }}.detach();
  return stop.get_token();
}

}  // namespace docent::apps
