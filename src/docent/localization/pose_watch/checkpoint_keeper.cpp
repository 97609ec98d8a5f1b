#include "docent/localization/pose_watch/checkpoint_keeper.h"

#include <utility>

namespace docent::localization {
namespace {

constexpr Duration kClocksApart = std::chrono::milliseconds{250};  // a stamp of a scan may be so far ahead of the bus

}  // namespace

CheckpointKeeper::CheckpointKeeper(std::filesystem::path path, std::string map_hash)
    : path_{std::move(path)}, map_hash_{std::move(map_hash)} {}

std::optional<LocalizerCheckpoint> CheckpointKeeper::restore(Time now) {
  auto checkpoint = recent_checkpoint(path_, map_hash_, now, kClocksApart);
  if (checkpoint) restored_ = checkpoint->odom_from_robot;
  return checkpoint;
}

bool CheckpointKeeper::is_contradicted_by(const Pose2& odom_from_base) {
  const bool is_contradicted = restored_ && distance(restored_->position(), odom_from_base.position()) > kCheckpointWay;
  restored_.reset();
  return is_contradicted;
}

void CheckpointKeeper::keep(Time stamp, const Pose2& raw_from_robot, const std::vector<BeliefMode>& modes, Time now) {
  if (now - kept_ < kCheckpointEvery) return;
  kept_ = now;
  // A checkpoint that cannot be written costs a restarted robot a new search, nothing else.
  (void)save_localizer_checkpoint({map_hash_, stamp, raw_from_robot, modes}, path_);
}

}  // namespace docent::localization
