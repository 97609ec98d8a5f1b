#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/localization/belief/belief_summary.h"

namespace docent::localization {

inline constexpr Duration kCheckpointEvery = std::chrono::seconds{1};
inline constexpr Duration kCheckpointAge = std::chrono::seconds{60};  // an older one tells nothing
inline constexpr double kCheckpointWay = 5.0;                         // [m] that odometry may have gone on meanwhile

/// What lets a restarted localizer go on: the belief's modes and where odometry was then.
struct LocalizerCheckpoint {
  std::string map_hash;
  Time time;
  Pose2 odom_from_robot;
  std::vector<BeliefMode> modes;
};

/// Outlives the process, and waits for no disk: after a power failure the robot's odometry begins anew, and an old
/// place tells nothing.
[[nodiscard]] Result<void> save_localizer_checkpoint(const LocalizerCheckpoint& checkpoint,
                                                     const std::filesystem::path& path);
/// Error: absent or damaged; the caller then starts with an unknown place.
[[nodiscard]] Result<LocalizerCheckpoint> load_localizer_checkpoint(const std::filesystem::path& path);
/// The same where it tells something: it is of this map, and of the last minute. One of the future is of a clock that
/// was set.
/// @param ahead  so far ahead of `now` its stamp may be all the same
[[nodiscard]] std::optional<LocalizerCheckpoint> recent_checkpoint(const std::filesystem::path& path,
                                                                   const std::string& map_hash, Time now,
                                                                   Duration ahead = Duration{0});

}  // namespace docent::localization
