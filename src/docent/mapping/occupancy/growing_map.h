#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/mapping/occupancy/scan_mapper.h"

namespace docent::mapping {

/// One laser's sweep of a moment, and where the laser was on the base.
struct MountedSweep {
  sensor_models::RangeSweep sweep;  ///< as the laser saw it
  Pose2 base_from_sensor;
};

/// The occupancy map of a drive that goes on, while the poses of what was seen before still move: it is drawn anew
/// behind the one that is in use, a few moments at a time, and changed for it when all of it is drawn.
class GrowingMap {
 public:
  /// @param body_radius  [m]: so far about its pose the robot's body shows that the floor is free
  /// @pre params are valid
  GrowingMap(const ScanMapperParams& params, double body_radius);

  /// What was seen at the newest moment. O(cells in view).
  void add(std::vector<MountedSweep> sweeps, const Pose2& map_from_base);
  /// Where the robot was at each moment so far. What it was drawn at counts as the same within a few centimetres.
  void move(std::span<const Pose2> map_from_base);
  /// Draws at most so many moments anew. @returns whether the map in use is up to date
  bool work(std::size_t most_moments);

  [[nodiscard]] OccupancyGrid map() const;  ///< O(cells); no cells before the first moment
  [[nodiscard]] std::size_t moments() const { return moments_.size(); }
  /// [m] all sweeps with a place, to draw a map of them otherwise.
  [[nodiscard]] std::vector<PlacedSweep> placed(std::span<const Pose2> map_from_base) const;

 private:
  struct Moment {
    std::vector<MountedSweep> sweeps;
    Pose2 map_from_base;
  };
  struct Drawing {
    ScanMapper mapper;
    GridFrame frame;
    std::vector<Pose2> drawn_at;  ///< of each moment so far
  };
  void draw(Drawing& drawing, const Moment& moment) const;
  [[nodiscard]] std::optional<Drawing> blank() const;
  [[nodiscard]] bool is_in(const GridFrame& frame, const Moment& moment) const;

  ScanMapperParams params_;
  double body_radius_;
  std::vector<Moment> moments_;
  std::optional<Drawing> in_use_;
  std::optional<Drawing> next_;
  bool is_outgrown_ = false;  ///< something was seen beyond the map in use
};

}  // namespace docent::mapping
