#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/apps/shared/robot_maker.h"
#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/evaluation/deployment_report.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/localization_messages.h"

namespace docent::apps::simulate_command {

/// What `docent simulate` takes.
struct SimulationRunOptions {
  std::string museum;
  std::string robot;                  ///< robot.yaml; empty: all defaults
  std::vector<std::string> settings;  ///< section.key=value, over robot.yaml
  std::uint64_t seed = 1;
  std::string crowd = "busy";
  std::optional<std::size_t> people;  ///< instead of the crowd level's density
  std::string bodies = "discs";       ///< how people are built: legs, or discs down to the floor
  std::optional<double> heedless;     ///< 0..1 share of people who do not evade
  std::optional<double> requests_per_hour;
  std::string scenario;                          ///< file; empty: nothing special happens
  std::optional<Pose2> start;                    ///< none: somewhere in the area, drawn from the seed
  std::string mode = "open";                     ///< hours: what the museum's hours say
  Duration day_begins = std::chrono::hours{10};  ///< the time of day at which the run begins
  std::optional<double> max_speed;               ///< [m/s] instead of the mode's limit
  std::string recording;                         ///< MCAP file; empty: none
  std::string claims;                            ///< CSV file of every belief beside the truth; empty: none
  std::string health_log;                        ///< CSV file of what the modules said of themselves; empty: none
  std::string event_log;         ///< CSV file of what happened and where the robot was then; empty: none
  std::string request_log;       ///< CSV file of requests, explanations and orders of visits; empty: none
  std::string drive_log;         ///< CSV file of how it drives beside what avoid says; empty: none
  std::string travel_times;      ///< CSV file of the ways whose time was learned, also before this run; empty: none
  std::string office_log;        ///< CSV file of deliveries, tidying up and things seen; empty: none
  std::string thing_log;         ///< CSV file of when things put up were seen, and when the map had them; empty: none
  std::string people_log;        ///< CSV file of tracked people beside the true ones; empty: none
  std::string camera_pictures;   ///< folder for what both cameras saw last; empty: none are simulated
  std::string state;             ///< folder; empty: a temporary one that goes with the run
  std::string cache;             ///< folder, see ModuleContext; empty: nothing is kept
  bool hosts_web = false;        ///< the page too
  bool profile = false;          ///< costs are counted by the processor's time, which is slower to ask for
  std::optional<Pose2> explore;  ///< the robot begins here and maps the museum by itself; none: it has its map
  bool has_robot = true;         ///< false: the world and the robot's body alone, no module
  std::shared_ptr<RobotMaker> robot_maker = std::make_shared<RobotMaker>();
};

/// The whole robot and its museum in one process in virtual time: simulator, modules, evaluation. One thread,
/// deterministic for a seed.
class SimulationRun {
 public:
  [[nodiscard]] static Result<std::unique_ptr<SimulationRun>> create(const SimulationRunOptions& options);
  ~SimulationRun();
  SimulationRun(const SimulationRun&) = delete;
  SimulationRun& operator=(const SimulationRun&) = delete;

  /// Error: the recording could not be written, or a module that was killed could not start again.
  [[nodiscard]] Result<void> run_until(Time end);
  [[nodiscard]] Time now() const;

  /// What the robot said last of its exploration.
  [[nodiscard]] std::optional<docent_msgs::Exploration> exploration() const;
  /// The deployment report so far (architecture 9), JSON.
  [[nodiscard]] std::string report_json() const;
  /// The same for people.
  [[nodiscard]] std::string summary() const;
  /// One line about the present: for progress.
  [[nodiscard]] std::string status() const;
  /// Seconds of all module steps so far, the simulator's and the evaluation's among them: of the processor where
  /// `profile` was asked for, else by the wall.
  [[nodiscard]] std::map<std::string, double> seconds_by_module() const;
  [[nodiscard]] evaluation::RunCost cost() const;
  /// Closes the recording.
  [[nodiscard]] Result<void> finish();
  /// The way driven over the map, with hazards, exhibits, home and touches.
  [[nodiscard]] Result<void> save_picture(const std::string& path) const;

 private:
  class Parts;
  explicit SimulationRun(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace docent::apps::simulate_command
