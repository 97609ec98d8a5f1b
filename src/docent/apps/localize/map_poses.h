#pragma once

#include <span>
#include <vector>

#include "docent/geometry/pose2.h"
#include "docent/mapping/graph_mapping/graph_mapper.h"
#include "docent/recording/laser_log.h"

namespace docent::apps::localize_command {

/// Scans of all lasers together, where the robot has moved, each with its index in the log.
struct ChosenScans {
  std::vector<mapping::MappingScan> scans;
  std::vector<std::size_t> indices;
  std::vector<std::size_t> sources;  ///< all scans of the log that took part, those of a second laser among them
};
[[nodiscard]] ChosenScans choose_scans(const recording::LaserLog& log, const mapping::ScanChoiceParams& params,
                                       const mapping::PointSweepParams& points);

/// Poses of all scans of the log, from those of some, `indices` in the log: between these odometry tells the way, bent
/// so that it meets both. @pre at least one index; they rise
[[nodiscard]] std::vector<Pose2> poses_of_all(const recording::LaserLog& log, std::span<const std::size_t> indices,
                                              std::span<const Pose2> map_from_base);

}  // namespace docent::apps::localize_command
