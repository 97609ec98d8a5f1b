#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "docent/grid/occupancy_grid.h"
#include "docent/localization/judgement/hindsight.h"
#include "docent/localization/localizer/localizer.h"
#include "docent/recording/laser_log.h"

namespace docent::apps::localize_command {

/// The value below which a share q of `values` lies; 0 for none.
[[nodiscard]] double quantile(std::vector<double> values, double q);

/// Where the robot was at one scan of a log.
struct LoggedPose {
  std::size_t scan = 0;              ///< index in the log, also in a reversed run
  double time = 0.0;                 ///< [s] of the log
  Pose2 map_from_base{};             ///< where it was said to be, see localization::ToldPose
  std::optional<Pose2> best_mode{};  ///< map_from_base likewise, of the belief's best mode, whatever was said
  bool has_pose = false;             ///< there was a pose to tell
  bool localized = false;            ///< the robot said where it is, there and then
  bool has_found = false;            ///< it had found a place, see localization::Verdict
  std::optional<Pose2>
      hindsight{};  ///< map_from_base, now that the whole way is over, see localization::HindsightParams
  double p_lost = 1.0;
  localization::Doubt doubt{};  ///< what P(lost) was made of
  [[nodiscard]] bool is_known() const { return localized || hindsight; }
  /// The best that is known now: in hindsight, else there and then.
  [[nodiscard]] const Pose2& best() const { return hindsight ? *hindsight : map_from_base; }
  [[nodiscard]] bool has_best() const { return has_pose || hindsight; }
  /// The robot said that it was at one place, and was at another.
  [[nodiscard]] bool is_taken_back() const;
};

struct LogRun {
  std::vector<LoggedPose> poses;               ///< of every scan, in the order of the log
  std::optional<std::size_t> localized_after;  ///< scans until the robot first said where it is
  std::vector<double> seconds;                 ///< wall time of every scan that led to an update
  double seconds_first = 0.0;
  std::size_t beams_used = 0;
  std::size_t beams_filtered = 0;
  std::size_t updates = 0;
  double fit = 0.0;  ///< mean ln P(d | o) of a beam at the best mode
};

struct LogRunOptions {
  bool reverse = false;         ///< scans from the last to the first, with inverse odometry
  std::optional<Pose2> start;   ///< map_from_base at the first scan; nullopt: unknown
  bool dead_reckoning = false;  ///< crippled: once it knows where it is, odometry alone
  /// After every scan: localizer, index in the log, what the scan did (for pictures).
  std::function<void(const localization::Localizer&, std::size_t, const localization::Localizer::Step&)> watch;
};

/// What is localized, seen from the robot. With one laser the *laser*, moved by its own odometry, and the robot's pose
/// follows from it: seen from the robot's centre, a beam along a wall would pass through the door post. With two lasers
/// the robot's centre.
[[nodiscard]] Pose2 base_from_tracked(bool has_two_lasers, const recording::LoggedScan& scan);
[[nodiscard]] bool has_two_lasers(const recording::LaserLog& log);

/// Localizes every scan of a log.
[[nodiscard]] LogRun localize_log(const recording::LaserLog& log, localization::Localizer& localizer,
                                  const LogRunOptions& options);

/// Adds to a run what is known of it in hindsight.
void look_back(const recording::LaserLog& log, bool reverse, const sensor_models::RayCaster& caster,
               localization::HindsightParams params, LogRun& run);

/// The scan in the laser's frame.
[[nodiscard]] sensor_models::RangeSweep sweep_of(const recording::LoggedScan& scan, double max_range);

/// Share of the log's readings that end on what has come or gone within a second, see localization::MovedThings:
/// whether people walk through it. Of some hundred pairs of scans, evenly over the log. O(scans + pairs * beams)
[[nodiscard]] double moving_share(const recording::LaserLog& log);

/// Share of the valid endpoints within `distance` [m] of an occupied cell, over the scans since localization; nullopt:
/// there is none.
[[nodiscard]] std::optional<double> endpoints_near_walls(const recording::LaserLog& log, const LogRun& run,
                                                         const sensor_models::RayCaster& caster, double distance);

/// How two runs over one log agree, over the scans after both were localized (in a reversed run: before).
struct RunAgreement {
  std::size_t scans = 0;  ///< since both were localized
  std::size_t both_know =
      0;               ///< of them, in which both know where they were, in hindsight too; only these are compared
  double share = 0.0;  ///< of those, within 0.5 m and 10 degrees
  double median_m = 0.0, p95_m = 0.0, max_m = 0.0;
};
[[nodiscard]] RunAgreement agreement_of(const std::vector<LoggedPose>& first, const std::vector<LoggedPose>& second);
/// Likewise, of what both said there and then.
[[nodiscard]] RunAgreement agreement_there_and_then(std::vector<LoggedPose> first, std::vector<LoggedPose> second);

[[nodiscard]] Result<void> save_poses(const std::vector<LoggedPose>& poses, const std::string& path);
[[nodiscard]] Result<std::vector<LoggedPose>> load_poses(const std::string& path);

}  // namespace docent::apps::localize_command
