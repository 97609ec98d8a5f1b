#pragma once

#include <optional>
#include <span>

#include "docent/collision_avoidance/watches/complaint.h"
#include "docent/geometry/pose2.h"

namespace docent {

struct BelievedPose {
  Pose2 map_from_robot;
  double mass = 0.0;
};

/// A belief as far as it says how fast to drive.
struct BeliefOutline {
  std::span<const BelievedPose> cells;
  std::span<const BelievedPose> hypotheses;  ///< by falling mass
  double p_lost = 1.0;
  bool localized = false;
};

/// Slows the robot for what it does not know of its place (safety rule 4): hazards are kept clear of from the whole
/// belief anyway, but the way is steered by the best pose. Unsure at all; a second mode of at least a third of the best
/// one's mass; or a best pose that is not where the cells round it lie. The last two count when two beliefs in
/// succession say so. O(cells) a belief.
class PositionDoubt {
 public:
  void believe(const BeliefOutline& belief);
  [[nodiscard]] std::optional<Complaint> complaint() const { return complaint_; }

 private:
  std::optional<Complaint> before_;
  std::optional<Complaint> complaint_;
};

/// Mean place and heading of the cells within 1.5 m and 45 degrees of `pose`, seen from it; nullopt when less than a
/// tenth of the mass lies there.
[[nodiscard]] std::optional<Pose2> mean_offset(const Pose2& pose, std::span<const BelievedPose> cells);

}  // namespace docent
