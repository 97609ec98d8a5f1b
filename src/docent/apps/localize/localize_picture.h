#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "docent/apps/localize/localize_log.h"
#include "docent/pictures/animation.h"
#include "docent/pictures/map_picture.h"

namespace docent::apps::localize_command {

/// The belief finding itself: a film of one frame an update until some time after the robot knows where it is, and a
/// figure of four of these moments.
class BeliefMovie {
 public:
  /// @pre both outlive the movie
  BeliefMovie(const OccupancyGrid& map, const recording::LaserLog& log) : map_{map}, log_{log} {}
  [[nodiscard]] Result<void> add(const localization::Localizer& localizer, std::size_t scan);
  /// An animated WebP.
  [[nodiscard]] Result<void> save(const std::filesystem::path& path);
  /// The first, the third and the fifth update, and the first after which the robot knew (or the last one).
  [[nodiscard]] pictures::Figure moments() const;
  [[nodiscard]] bool is_full() const;  ///< enough frames

 private:
  const OccupancyGrid& map_;
  const recording::LaserLog& log_;
  std::optional<pictures::Animation> animation_;  ///< since the first frame, which says how large they are
  std::vector<pictures::Axes> first_;
  std::optional<pictures::Axes> known_;
  int frames_ = 0;
  int frames_localized_ = 0;
};

/// Belief summed over headings, the scan at the best pose; without its colour bar.
[[nodiscard]] pictures::Axes belief_axes(const OccupancyGrid& map, const localization::Localizer& localizer,
                                         const recording::LaserLog& log, std::size_t scan);

/// One scan at its pose, 24 m of the map around the robot.
[[nodiscard]] pictures::Figure draw_scan(const OccupancyGrid& map, const recording::LaserLog& log,
                                         const LoggedPose& pose);

/// What a piece of the way is.
enum class WayKind {
  kSaid,       ///< the robot said where it was, there and then
  kHindsight,  ///< it did not know, but it is known by now
  kUnsure,     ///< nobody knows: its best hypotheses
  kTakenBack,  ///< where it said that it was, and was not, as is known by now
};

/// The pieces of one kind: one ends where another kind begins, or where the pose jumps.
[[nodiscard]] std::vector<std::vector<Point2>> ways_of(const recording::LaserLog& log, const LogRun& run, WayKind kind);

/// The way through the map, by kinds of its pieces, with its start and end, and scans drawn at their
/// poses along it (every `stride`-th). Beneath it the reference's way, broad, where there is one. Cropped to what is
/// shown.
[[nodiscard]] pictures::Figure draw_run(const OccupancyGrid& map, const recording::LaserLog& log, const LogRun& run,
                                        std::size_t stride, const std::vector<std::optional<Pose2>>& reference);

}  // namespace docent::apps::localize_command
