#include "docent/planning/survey/survey_store.h"

#include <system_error>

#include "docent/base/files.h"

namespace docent::planning {

SurveyStore::SurveyStore(const std::filesystem::path& state)
    : folder_{state / "explored"},
      checkpoint_{state / "explore.yaml"},
      localizers_checkpoint_{state / "localize.yaml"} {}

std::optional<localization::LocalizerCheckpoint> SurveyStore::restored(Time now) const {
  return localization::recent_checkpoint(checkpoint_, kMapHash, now);
}

void SurveyStore::keep_place(const localization::BeliefMode& mode, const Pose2& odom_from_base, Time now) const {
  localization::LocalizerCheckpoint checkpoint{kMapHash, now, odom_from_base, {mode}};
  // A checkpoint that cannot be written costs a search, nothing else.
  (void)localization::save_localizer_checkpoint(checkpoint, checkpoint_);
  if (finished_map_.empty()) return;
  checkpoint.map_hash = finished_map_;
  (void)localization::save_localizer_checkpoint(checkpoint, localizers_checkpoint_);
}

Result<std::string> SurveyStore::save(const OccupancyGrid& map, std::span<const Pose2> map_from_base) {
  std::error_code code;
  std::filesystem::create_directories(folder_, code);
  if (code) return fail(folder_.string() + ": cannot be made: " + code.message());
  std::string text = "# x y theta: m, m, rad\n";
  for (const Pose2& pose : map_from_base) {
    text += std::to_string(pose.x) + " " + std::to_string(pose.y) + " " + std::to_string(pose.theta.radians()) + "\n";
  }
  if (auto saved = write_file_atomically(folder_ / "poses.txt", text); !saved)
    return tl::unexpected<Error>(saved.error());
  if (auto saved = save_map(map, folder_ / "map"); !saved) return tl::unexpected<Error>(saved.error());
  const std::string file = (folder_ / "map.yaml").string();
  if (const auto written = load_map(file)) finished_map_ = map_hash(*written);
  return file;
}

}  // namespace docent::planning
