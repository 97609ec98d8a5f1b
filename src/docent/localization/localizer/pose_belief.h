#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/belief/neighbourhood.h"
#include "docent/localization/belief/observation_model.h"
#include "docent/localization/expected_ranges/expected_ranges.h"
#include "docent/localization/localizer/update_cadence.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// The belief over positions, all headings together.
struct PositionDensity {
  GridFrame frame;
  std::vector<float> mass;  ///< [rows * columns]
};

/// What one update has to say of where the robot is: s of [Markov1998] eq. 1, and how far it may be trusted.
struct SensorEvidence {
  const sensor_models::RangeSweep& seen;             ///< in the belief's frame
  std::span<const sensor_models::BinnedBeam> beams;  ///< those that count, by rising direction
  std::span<const LikelyState> likely;               ///< before the update; empty: the belief is too wide
  ObservationModels& others;                         ///< sensors beside the lasers
  Time time;
  Pose2 odom_from_robot;
  double weight = 1.0;       ///< 0..1 of a full update
  double views = 1.0;        ///< LocalizerParams::views
  double sector_nats = 0.0;  ///< LocalizerParams::sector_nats
  bool keeps_its_place = false;
  bool in_doubt = false;               ///< the readings contradict the map: somebody may have carried the robot
  std::optional<Neighbourhood> focus;  ///< of the robot: where evidence is sharp, once it keeps its place
};

/// The belief over the robot's pose in a map, as the cycle of `Localizer` keeps it up: a grid or samples. What is drawn
/// at random comes from the `Rng` that is given. The belief may be over the poses of a frame that goes along with the
/// robot, as odometry sees it, instead of the robot's own.
class PoseBelief {
 public:
  PoseBelief() = default;
  PoseBelief(const PoseBelief&) = delete;
  PoseBelief& operator=(const PoseBelief&) = delete;
  virtual ~PoseBelief() = default;

  /// All places alike; nothing of odometry is known.
  virtual void start_unknown() = 0;
  /// Odometry begins here.
  virtual void set_out(const Pose2& odom_from_robot) = 0;
  /// The modes, of the robot at the last update, and `elsewhere` of the mass on all other poses where the belief can
  /// hold it.
  virtual void believe(std::span<const BeliefMode> modes, double elsewhere, Rng& rng) = 0;

  /// The action update, [Markov1998] eq. 2. `odom_from_robot`: after the motion.
  virtual void predict(const Motion& motion, const Pose2& odom_from_robot, bool keeps_its_place) = 0;

  struct Reweighed {
    double weight = 1.0;  ///< 0..1 of a full update that the evidence had in the end
    double work = 0.0;    ///< states * beams
  };
  /// The sensor update, [Markov1998] eq. 1.
  virtual Reweighed reweigh(const SensorEvidence& evidence, Rng& rng) = 0;
  /// Draws anew near the likeliest pose of the robot and elsewhere, where the belief is of samples.
  virtual void resample(const Pose2& /*likeliest*/, Rng& /*rng*/) {}
  /// A search has found the robot at `found`, with probability `share`: the mass in focus follows it.
  virtual void gather(const Pose2& found, const Neighbourhood& focus, double share) = 0;
  /// Everything may be wrong: nearly all mass goes elsewhere, now (true: the belief has changed) or at the next update.
  virtual bool flood() = 0;

  /// Of the robot's pose.
  [[nodiscard]] virtual BeliefSummary summarise() = 0;
  /// The part of the belief that matters; empty: it is too wide. In the belief's frame.
  [[nodiscard]] virtual std::vector<LikelyState> likely() const = 0;
  [[nodiscard]] virtual PositionDensity density() const = 0;

  /// At the last update.
  [[nodiscard]] virtual Pose2 odom_from_frame() const = 0;
  /// A sweep of the last update in the belief's frame.
  [[nodiscard]] virtual sensor_models::RangeSweep in_frame(const sensor_models::RangeSweep& sweep) const = 0;
  /// Where the frame is when the robot is there.
  [[nodiscard]] virtual Pose2 map_from_frame(const Pose2& map_from_robot) const = 0;
};

}  // namespace docent::localization
