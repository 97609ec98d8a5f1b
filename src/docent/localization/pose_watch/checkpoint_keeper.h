#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/localization/belief/checkpoint.h"

namespace docent::localization {

/// Lets a robot that was restarted go on where it was: writes its place down once a second, and finds out whether it
/// still stands there.
class CheckpointKeeper {
 public:
  /// @param map_hash  of the map that the places are in
  CheckpointKeeper(std::filesystem::path path, std::string map_hash);

  /// Where the robot was a moment ago, before it was restarted; none: nobody knows where it stands now.
  [[nodiscard]] std::optional<LocalizerCheckpoint> restore(Time now);
  /// Odometry speaks. @returns whether it contradicts the place that was restored: the robot has been moved, or its
  /// odometry began anew. Only the first time that it speaks.
  [[nodiscard]] bool is_contradicted_by(const Pose2& odom_from_base);
  /// The robot is told its place: what was restored is of no account.
  void forget_restored() { restored_.reset(); }
  /// Writes the place down, if it is time.
  /// @param raw_from_robot  where its odometry saw the robot at `stamp`, when it was as `modes` say
  void keep(Time stamp, const Pose2& raw_from_robot, const std::vector<BeliefMode>& modes, Time now);

 private:
  std::filesystem::path path_;
  std::string map_hash_;
  std::optional<Pose2> restored_;  ///< odometry of the checkpoint, until odometry speaks
  Time kept_{};
};

}  // namespace docent::localization
