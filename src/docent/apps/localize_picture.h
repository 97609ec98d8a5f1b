#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "docent/apps/localize_log.h"
#include "docent/pictures/animation.h"
#include "docent/pictures/map_picture.h"

namespace docent {

/// The belief finding itself, one frame an update until some time after the robot knows, as an animated WebP.
class BeliefMovie {
 public:
  [[nodiscard]] static Result<BeliefMovie> create(const OccupancyGrid& map);
  [[nodiscard]] Result<void> add(const Localizer& localizer, const LoggedScan& scan, double max_range, bool two_lasers);
  [[nodiscard]] Result<void> save(const std::filesystem::path& path);
  [[nodiscard]] bool is_full() const;  ///< enough frames

 private:
  BeliefMovie(const OccupancyGrid& map, Animation animation);
  MapView view_;
  Image map_picture_;
  Animation animation_;
  int frames_ = 0;
  int frames_localized_ = 0;
};

/// Belief summed over headings, the scan at the best pose.
[[nodiscard]] Image draw_belief(const Image& map_picture, const MapView& view, const Localizer& localizer,
                                const LoggedScan& scan, double max_range, bool two_lasers);

/// One scan at its pose, 24 m of the map around the robot.
[[nodiscard]] Image draw_scan(const OccupancyGrid& map, const LoggedScan& scan, double max_range,
                              const LoggedPose& pose);

/// The way through the map, and scans drawn at their poses along it (every `stride`-th). Beneath it the reference's
/// way, broad, where there is one.
[[nodiscard]] Image draw_run(const OccupancyGrid& map, const LaserLog& log, const LogRun& run, std::size_t stride,
                             const std::vector<std::optional<Pose2>>& reference);

}  // namespace docent
