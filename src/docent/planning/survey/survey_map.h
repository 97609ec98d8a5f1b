#pragma once

#include <functional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/mapping/graph_mapping/graph_mapping.h"
#include "docent/mapping/occupancy/growing_map.h"
#include "docent/planning/survey/keyframes.h"

namespace docent::planning {

/// [m2] of the map's free floor. O(cells)
[[nodiscard]] double free_area(const OccupancyGrid& map);

/// The map of a survey: the poses of all moments so far, which later ones may still move, and the floor that was seen
/// from them; in the end all of it once more from the best poses.
class SurveyMap {
 public:
  /// @param body_radius  [m]: so far about its pose the robot's body shows that the floor is free
  /// @pre params are valid
  SurveyMap(const mapping::GraphMapperParams& mapping, const mapping::ScanMapperParams& map, double body_radius);

  /// @param moment  its odometry begins where the robot begins in the survey
  /// @returns where the robot was then, site. O(points), and now and then a search for loops
  Pose2 add(Keyframe moment);
  /// The site, in whose frame the map is drawn, lies elsewhere than where the robot took it to lie.
  void lie(const Pose2& site_from_survey);
  static constexpr double kWallsApart = 0.15;  ///< [m]
  /// [m], survey: some points of what was seen, at most one in so many metres, with normals. O(moments)
  [[nodiscard]] std::vector<mapping::SurfacePoint> walls(double apart) const;
  /// [m], site: where the robot was at each moment, by what is known now. O(moments)
  [[nodiscard]] std::vector<Point2> trail() const;
  /// Follows the poses that have moved since, a hundred moments a call.
  void follow();
  /// What is known now is looked at: `seen` and `known_m2`. O(cells)
  void look();

  [[nodiscard]] const OccupancyGrid& seen() const { return seen_; }  ///< when it was looked at last
  [[nodiscard]] double known_m2() const { return known_m2_; }        ///< of free floor, likewise
  [[nodiscard]] OccupancyGrid drawn() const { return map_.map(); }   ///< now. O(cells)
  [[nodiscard]] const mapping::GraphMapping& poses() const { return poses_; }

  struct Finished {
    OccupancyGrid map;
    std::vector<Pose2> map_from_base;  ///< of all moments
    std::string warning;               ///< why the map is not to be trusted; empty: it is
  };
  struct LastTouches {
    double standing_room = 0.265;  ///< [m], >= 0, about every pose was free, for the robot stood there
    double stray_floor = 0.5;      ///< [m2], >= 0: less free floor than that in one piece was seen by stray beams
  };
  /// Where the site lies, by some of the walls (see `walls`) from the best poses.
  using SiteOf = std::function<Pose2(const std::vector<mapping::SurfacePoint>& walls)>;
  /// No moment may follow. Error: nothing was seen, or too wide a building.
  [[nodiscard]] Result<Finished> finish(const LastTouches& touches, const SiteOf& site_of = {});

 private:
  [[nodiscard]] std::vector<Pose2> in_site(std::span<const Pose2> survey_from_base) const;

  mapping::ScanMapperParams params_;
  Pose2 site_from_survey_;  ///< the map is of the site; the poses of the graph are the survey's
  std::vector<std::vector<mapping::SurfacePoint>> walls_;  ///< [moments] [m], base: some of what was seen
  mapping::GraphMapping poses_;
  mapping::GrowingMap map_;
  std::size_t revision_ = 0;
  bool lies_elsewhere_ = false;  ///< since it was drawn
  OccupancyGrid seen_;
  double known_m2_ = 0.0;
};

}  // namespace docent::planning
