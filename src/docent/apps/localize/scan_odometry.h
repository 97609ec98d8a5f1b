#pragma once

#include <cstddef>
#include <string>

#include "docent/mapping/graph_mapping/graph_mapper.h"
#include "docent/recording/laser_log.h"

namespace docent::apps::localize_command {

/// When motion that scans alone tell is believed.
struct ScanOdometryParams {
  double longest = 1.0;      ///< [s], > 0: over a longer gap nothing says that the robot went on as before
  double blind = 0.05;       ///< [m], > 0: a match that leaves any direction so uncertain tells no motion along it
  double most_blind = 0.02;  ///< 0..1: share of steps without a motion of their own up to which a map is trusted
};

/// What came of it.
struct ScanOdometry {
  std::size_t steps = 0;  ///< from one scan of the front laser to the next
  std::size_t blind = 0;  ///< of which scans do not tell the whole motion: they lie on nothing, or along a bare passage
  /// Why a map made with it is not to be trusted; empty: it may be.
  [[nodiscard]] std::string doubt(const ScanOdometryParams& params = {}) const;
};

/// Whether no odometry says how the robot moved: there is none, or it never moves.
[[nodiscard]] bool has_no_odometry(const recording::LaserLog& log);

/// Gives the scans of a log without odometry one made of themselves: each is laid onto those before it, about the place
/// where it would be had the robot gone on as it did. Where a scan tells nothing the robot is taken to go on.
/// O(scans * points).
ScanOdometry odometry_by_scans(recording::LaserLog& log, const mapping::GraphMapperParams& matching,
                               const ScanOdometryParams& params = {});

}  // namespace docent::apps::localize_command
