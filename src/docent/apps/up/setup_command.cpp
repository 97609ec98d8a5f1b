#include "docent/apps/up/setup_command.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <system_error>

#include "docent/apps/shared/arguments.h"
#include "docent/apps/shared/command.h"
#include "docent/apps/up/robot_run.h"
#include "docent/museum/editing/museum_setup.h"
#include "docent/simulator/world/world.h"
#include "docent/telepresence/accounts/accounts.h"

namespace docent::apps::up_command {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTechnician = "setup";  // the account for the time of the set-up

/// Somebody may log in as `setup`, with a new password each time.
class Technician {
 public:
  explicit Technician(const std::string& state)
      : database_{value_or_fail(telepresence::Database::open((fs::path{state} / "web.sqlite").string()))},
        accounts_{value_or_fail(telepresence::Accounts::open(*database_))},
        password_{telepresence::make_token().substr(0, 16)} {
    (void)accounts_->remove(kTechnician);  // of a run that was killed
    const Time now{std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count()};
    value_or_fail(accounts_->add(kTechnician, password_, telepresence::Rank::operator_, now));
  }
  Technician(const Technician&) = delete;
  Technician& operator=(const Technician&) = delete;
  ~Technician() { (void)accounts_->remove(kTechnician); }

  [[nodiscard]] const std::string& password() const { return password_; }

 private:
  std::unique_ptr<telepresence::Database> database_;
  std::unique_ptr<telepresence::Accounts> accounts_;
  std::string password_;
};

/// Where the robot of a simulated place waits.
Pose2 home_in(const std::string& world) {
  std::error_code ignored;
  if (!fs::is_regular_file(world, ignored)) return value_or_fail(museum::load_museum(world)).home;
  const Point2 home = value_or_fail(simulator::load_world(world)).home;
  return {home.x, home.y, {}};
}

/// The world of a simulation, and where its robot wakes up: at home, without another word.
void simulate(RobotRun& run, const std::string& world) {
  run.simulate = true;
  run.simulator.world = world;
  if (run.simulator.start.empty()) run.simulator.start = pose_text(home_in(world));
}

void set_up(RobotRun run) {
  const std::string& folder = run.deployment.museum;
  // A simulated robot maps in the frame of its world, so that reports can compare the two.
  const Pose2 start = run.simulate ? parse_pose("--start", run.simulator.start) : Pose2{};
  value_or_fail(own_state(run.deployment));  // before anything is touched that another one works with
  const bool is_new = !fs::exists(fs::path{folder} / "setup.yaml");
  const auto progress = value_or_fail(museum::MuseumSetup::begin(folder, start), 2);
  run.deployment.is_setup = true;
  const museum::MuseumSetup setup{folder, run.deployment.state, {}};
  // A map of which nothing is kept begins anew, where the robot is now.
  const bool is_mapping = museum::work_of(progress.step) == museum::SetupWork::map;
  if (is_new || (is_mapping && !setup.has_explored())) value_or_fail(setup.map_again(start));
  if (run.simulate) {
    // The simulated robot is carried to its start: where it was before tells nothing.
    std::error_code ignored;
    for (const char* checkpoint : {"localize.yaml", "explore.yaml"})
      fs::remove(fs::path{run.deployment.state} / checkpoint, ignored);
  }
  std::printf("%s: step %s\n", folder.c_str(), to_text(progress.step));
  const Technician technician{run.deployment.state};
  run.page = "/setup#" + technician.password();
  run_robot(run);
}

}  // namespace

void add_setup_command(CLI::App& app) {
  auto options = std::make_shared<RobotRun>();
  auto world = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "setup", "Set up a museum in the browser: its map, hazards and exhibits, from an empty folder to the first tour");
  command
      ->add_option("folder", options->deployment.museum,
                   "Of the museum; made when there is none. What has begun goes on")
      ->required();
  options->deployment.add_options(*command, Deployment::Museum::is_given);
  command->add_option("--sim", *world,
                      "Try it without a robot, in a simulated place: a museum's folder, such as museums/bonn, or a "
                      "file simulation.yaml");
  command->add_option("--port", options->port, "Port of the page")->check(CLI::Range(1, 65535))->capture_default_str();
  options->simulator.crowd = "empty";
  options->simulator.requests_per_hour = 0.0;
  options->simulator.add_options(*command->add_option_group("With --sim"));
  for (const char* not_here : {"--explore", "--world"}) command->get_option(not_here)->group("");
  command->callback([options, world, command] {
    for (const std::string option : {"--crowd", "--start", "--scenario", "--requests-per-hour"})
      if (world->empty() && command->count(option) > 0)
        throw CommandFailed{option + " is of a simulated museum: it needs --sim", 2};
    if (command->count("--explore") > 0 || command->count("--world") > 0)
      throw CommandFailed{"--explore and --world are not for docent setup", 2};
    if (!world->empty()) simulate(*options, *world);
    set_up(*options);
  });
}

}  // namespace docent::apps::up_command
