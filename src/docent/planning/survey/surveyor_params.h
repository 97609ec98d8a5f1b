#pragma once

#include "docent/base/result.h"
#include "docent/mapping/graph_mapping/graph_mapper.h"
#include "docent/mapping/occupancy/scan_mapper.h"
#include "docent/planning/exploration/exploration_drive.h"
#include "docent/planning/exploration/explorer.h"
#include "docent/planning/mark_alignment/mark_alignment.h"
#include "docent/planning/survey/keyframes.h"

namespace docent::planning {

/// Section `explore`.
struct SurveyorParams {
  KeyframeParams keyframes;
  ExplorerParams explorer;
  ExplorationDriveParams drive;
  MarkAlignmentParams alignment;
  mapping::GraphMapperParams mapping;
  /// Free is what two sweeps at least have passed: a single beam may have lost its echo.
  mapping::ScanMapperParams map{.reach = 12.0, .empty_reach = 5.0, .free = 0.25, .fewest_hits = 2};
  double least_sigma = 0.04;     ///< [m], > 0: the pose is never known better, nor
  double most_sigma = 0.08;      ///< [m]: believed to be worse: hazards that are marked would close the building
  double sigma_heading = 0.02;   ///< [rad], > 0
  double stray_floor = 0.5;      ///< [m2], >= 0: less free floor than that in one piece was seen by stray beams
  bool waits_for_order = false;  ///< stands until a technician says who drives
  template <class V>
  void visit(V& v) {
    v("keyframes", keyframes);
    v("explorer", explorer);
    v("drive", drive);
    v("alignment", alignment);
    v("mapping", mapping);
    v("map", map);
    v("least_sigma", least_sigma);
    v("most_sigma", most_sigma);
    v("sigma_heading", sigma_heading);
    v("stray_floor", stray_floor);
    v("waits_for_order", waits_for_order);
  }
  [[nodiscard]] Result<void> validate() const;
};

}  // namespace docent::planning
