#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "docent/base/result.h"
#include "docent/recording/laser_log.h"

namespace docent::evaluation {

/// Where a recorded robot was, as somebody found out afterwards with more than the robot had: the truth of a real log.
struct TimedPose {
  Time time;
  Pose2 map_from_base;
};

/// Lines of "time x y theta" [s, m, m, rad]; "#" begins a comment. Sorted by time. Error: "FILE:LINE: …".
[[nodiscard]] Result<std::vector<TimedPose>> load_timed_poses(const std::filesystem::path& path);
/// The same from memory; `name` stands where the file's name would.
[[nodiscard]] Result<std::vector<TimedPose>> parse_timed_poses(std::string_view text, const std::string& name);

/// map_from_base of every scan of a log; nullopt where nobody knows.
using ScanReference = std::vector<std::optional<Pose2>>;

/// Between two poses the way is odometry's, bent so that it meets both.
struct ReferenceGaps {
  double most_seconds = 5.0;   ///< between two poses
  double most_degrees = 15.0;  ///< of a turn between them: odometry says little of when the robot turned
  double most_missed = 0.15;   ///< [m] that odometry may miss the second pose by, seen from the first, and
  double most_missed_degrees = 8.0;
  bool between_own_scans = true;  ///< place scans between those that have a pose; see below
};
/// The poses at the scans' times. A scan between two poses that differ by more than `gaps`, or by something else than
/// odometry says, has none, unless it has a pose's very time (10 us).
///
/// Where many scans have a pose's very time, the poses are those of the log's own scans, some of which were left out.
/// Then the other scans are placed between these by odometry alone, and `gaps` are of what odometry misses only: stamps
/// are often of a reading's arrival, some late, several at once, so that a pose half a second from a scan says nothing
/// of where the robot was at that scan. O((scans + poses) log).
[[nodiscard]] ScanReference reference_of(const recording::LaserLog& log, std::span<const TimedPose> poses,
                                         const ReferenceGaps& gaps = {});

/// The poses that a corrected log carries itself, in place of its odometry or beside it.
[[nodiscard]] ScanReference logged_reference(const recording::LaserLog& log);

}  // namespace docent::evaluation
