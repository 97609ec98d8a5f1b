#include "docent/mapping/graph_mapping/mapping_scan.h"

#include <cmath>

namespace docent::mapping {

bool ScanChoice::takes(const Pose2& odom_from_base) {
  if (last_) {
    const Pose2 moved = inverse(*last_) * odom_from_base;
    if (norm(moved.position()) < params_.way && std::abs(moved.theta.degrees()) < params_.turn) return false;
  }
  last_ = odom_from_base;
  return true;
}

}  // namespace docent::mapping
