#pragma once

#include <numbers>
#include <optional>
#include <span>

#include "docent/collision_avoidance/watches/complaint.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

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

struct PositionDoubtParams {
  double crippled_speed = 0.25;    ///< [m/s] as ComplaintParams::crippled_speed, with a doubtful position
  double unknown_speed = 0.4;      ///< [m/s] looking around: nothing is steered for by the map
  double doubtful = 0.5;           ///< P(lost)
  double rival_share = 1.0 / 3.0;  ///< of the best mode's mass: the robot may be in two places
  double rival_way = 0.5;          ///< [m] nearer modes are one place
  double rival_turn = 20.0 * std::numbers::pi / 180.0;  ///< [rad] likewise
  double off = 0.2;                                     ///< [m] from the best pose to the mean of the cells round it
  double off_turn = 6.5 * std::numbers::pi / 180.0;     ///< [rad] likewise
  double near = 1.5;                                    ///< [m] from the best pose: the cells round it
  double near_turn = 45.0 * std::numbers::pi / 180.0;   ///< [rad] likewise
  double least_mass = 0.1;                              ///< of these cells; fewer tell of no mean
};

/// Slows the robot for what it does not know of its place (safety rule 4): hazards are kept clear of from the whole
/// belief anyway, but the way is steered by the best pose. Unsure at all; a second mode of at least a third of the best
/// one's mass; or a best pose that is not where the cells round it lie. The last two count when two beliefs in
/// succession say so. O(cells) a belief.
class PositionDoubt {
 public:
  explicit PositionDoubt(const PositionDoubtParams& params = {}) : params_{params} {}

  void believe(const BeliefOutline& belief);
  [[nodiscard]] std::optional<Complaint> complaint() const { return complaint_; }

 private:
  [[nodiscard]] std::optional<Complaint> judge(const BeliefOutline& belief) const;

  PositionDoubtParams params_;
  std::optional<Complaint> before_;
  std::optional<Complaint> complaint_;
};

/// Mean place and heading of the cells near `pose`, seen from it; nullopt when too little mass lies there.
[[nodiscard]] std::optional<Pose2> mean_offset(const Pose2& pose, std::span<const BelievedPose> cells,
                                               const PositionDoubtParams& params = {});

}  // namespace docent::collision_avoidance
