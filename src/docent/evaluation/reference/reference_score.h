#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "docent/evaluation/reference/reference_poses.h"

namespace docent::evaluation {

/// What localization said at a scan.
struct LocalizedScan {
  std::optional<Pose2> map_from_base;  ///< the best mode
  bool localized = false;              ///< the robot says that it knows
};

/// A localized log against its reference, over the scans that have one, from the first in which the robot says where it
/// is, or from the very first where it was told. Lost, as everywhere: without a pose, or more than 0.5 m or 20 degrees
/// off.
struct ReferenceScore {
  std::size_t scans = 0;           ///< that count
  std::size_t waited = 0;          ///< scans before, with or without a reference
  std::size_t lost = 0;            ///< of those that count
  std::size_t sure_and_wrong = 0;  ///< of them, in which the robot said that it knows
  std::size_t unsure = 0;          ///< of those that count, in which it did not
  double mean_m = 0.0, median_m = 0.0, p95_m = 0.0, max_m = 0.0;
  double mean_deg = 0.0, max_deg = 0.0;
  [[nodiscard]] double lost_fraction() const {
    return scans == 0 ? 1.0 : static_cast<double>(lost) / static_cast<double>(scans);
  }
};

/// @pre both have one entry a scan. O(scans log scans).
[[nodiscard]] ReferenceScore score_against(const ScanReference& reference, std::span<const LocalizedScan> scans,
                                           bool start_is_known);

}  // namespace docent::evaluation
