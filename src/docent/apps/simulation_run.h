#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"
#include "docent/modules/module_host.h"
#include "docent/transport/virtual_time_bus.h"

namespace docent {

/// What `docent simulate` takes.
struct SimulationRunOptions {
  std::filesystem::path museum;
  std::optional<std::filesystem::path> robot;  ///< robot.yaml; none: defaults
  double hours = 0.5;
  std::uint64_t seed = 1;
  std::string crowd = "busy";
  std::optional<std::filesystem::path> scenario;
  std::optional<Pose2> start;  ///< none: somewhere in the area, drawn from the seed
  std::string mode = "open";
  std::vector<std::string> settings;               ///< --set section.key=value
  std::optional<std::filesystem::path> recording;  ///< --record
  std::optional<std::filesystem::path> state;      ///< none: a temporary folder, removed at the end
  bool web = false;                                ///< hosts the page as well (pace the run)
  double pacing = 0.0;                             ///< virtual seconds a wall second; 0: as fast as possible
};

/// The whole robot and its museum in one process in virtual time: simulator, modules, evaluation. One thread;
/// deterministic for a seed.
class SimulationRun {
 public:
  [[nodiscard]] static Result<std::unique_ptr<SimulationRun>> create(const SimulationRunOptions& options);
  ~SimulationRun();
  SimulationRun(const SimulationRun&) = delete;
  SimulationRun& operator=(const SimulationRun&) = delete;

  /// Runs up to virtual time `end`.
  void run_until(Time end);
  [[nodiscard]] Time now() const;

  /// Destroys a module as `kill -9` would, and makes it again after `delay`.
  void kill_module(const std::string& name, Duration delay);

  /// The deployment report so far, JSON (architecture 9).
  [[nodiscard]] std::string report_json() const;
  /// The same for people.
  [[nodiscard]] std::string summary() const;
  /// Closes the recording. Error: it could not be written.
  [[nodiscard]] Result<void> finish();
  /// Wall seconds by module so far, the simulator among them.
  [[nodiscard]] std::map<std::string, double> wall_seconds_by_module() const;
  /// The way driven, over the map, with hazards, exhibits and touches.
  [[nodiscard]] Result<void> save_picture(const std::filesystem::path& png) const;

 private:
  struct Parts;
  explicit SimulationRun(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace docent
