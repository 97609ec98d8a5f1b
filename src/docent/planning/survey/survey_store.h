#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/localization/belief/checkpoint.h"

namespace docent::planning {

/// What of a survey outlives the process, in the robot's folder of states: the place of the robot, so that it goes on
/// in the same frame, in which people have marked what no sensor sees; and the map in the end, in `explored/`.
class SurveyStore {
 public:
  static constexpr const char* kMapHash = "exploration";  ///< of a map that is not made yet, in belief and checkpoint

  /// @param state  exists
  explicit SurveyStore(const std::filesystem::path& state);

  /// Where the robot was a moment ago; none: nobody knows where it stands now.
  [[nodiscard]] std::optional<localization::LocalizerCheckpoint> restored(Time now) const;
  /// For the next process; and for `localize`, as soon as there is a map that it can go on in.
  void keep_place(const localization::BeliefMode& mode, const Pose2& odom_from_base, Time now) const;
  /// The map, and the poses [m] that it was seen from. @returns the map's file. Error: names the file.
  Result<std::string> save(const OccupancyGrid& map, std::span<const Pose2> map_from_base);

 private:
  std::filesystem::path folder_;
  std::filesystem::path checkpoint_;
  std::filesystem::path localizers_checkpoint_;
  std::string finished_map_;  ///< its hash; empty: it is not made yet
};

}  // namespace docent::planning
