#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/localization/belief/beam_origin.h"
#include "docent/localization/belief/belief_summary.h"
#include "docent/localization/belief/observation_model.h"
#include "docent/localization/belief/verdict.h"
#include "docent/sensor_models/range_sweep.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent {

/// The belief over positions, all headings together.
struct PositionDensity {
  GridFrame frame;
  std::vector<float> mass;  ///< [rows * columns]
};

/// A belief over the robot's pose in a map, kept up by sweeps of range readings and odometry: what grid and particles
/// have in common. Implementations are deterministic and know no wall clock.
class Localizer {
 public:
  Localizer() = default;
  Localizer(const Localizer&) = delete;
  Localizer& operator=(const Localizer&) = delete;
  virtual ~Localizer() = default;

  /// Another sensor, whose observations count in every update from now on.
  void add_sensor(std::shared_ptr<ObservationModel> sensor) { sensors_.add(std::move(sensor)); }

  virtual void start_unknown() = 0;
  /// `odom_from_robot`: where odometry saw the robot when it was as `modes` say.
  virtual void start_at(std::span<const BeliefMode> modes, const Pose2& odom_from_robot, Time time) = 0;

  struct Step {
    bool updated = false;
    std::size_t beams_used = 0;
    std::size_t beams_filtered = 0;  ///< of all beams of the sweep, one a direction
    double weight = 0.0;             ///< 0..1 of a full update
    /// Mean ln P(d | o) of the beams used, at the best mode: how well the map explains them. None without a mode.
    std::optional<double> fit;
  };
  /// Offers a sweep. Most are not needed: an update comes after some motion or time.
  virtual Step observe(const RangeSweep& sweep, const Pose2& odom_from_robot, Time time) = 0;

  [[nodiscard]] virtual const BeliefSummary& summary() const = 0;  ///< as of the last update
  [[nodiscard]] virtual const Verdict& verdict() const = 0;
  [[nodiscard]] virtual const Pose2& odom_from_robot() const = 0;  ///< at the last update
  /// Entropy gains [nat] of the beams of a sweep, H(L | s) - H(L): above 0 the beam would make the robot less sure
  /// ([Rhino1999] eq. 10). 0 where it would tell nothing; empty while the belief is too wide to ask.
  [[nodiscard]] virtual std::vector<float> entropy_gains(const RangeSweep& sweep, const Pose2& odom_now) const = 0;
  [[nodiscard]] virtual PositionDensity density() const = 0;  ///< for pictures
  [[nodiscard]] virtual const RayCaster& caster() const = 0;

  /// The best mode's mean, carried on by odometry; nullopt when there is no mode at all.
  [[nodiscard]] std::optional<Pose2> map_from_robot(const Pose2& odom_now) const {
    if (summary().modes.empty()) return std::nullopt;
    return summary().modes.front().map_from_robot * (inverse(odom_from_robot()) * odom_now);
  }
  /// What the beams of a sweep ended on, by the inverse filter. All unknown while not localized: then nobody can say
  /// what the map lets expect.
  [[nodiscard]] std::vector<BeamOrigin> origins(const RangeSweep& sweep, const Pose2& odom_now, double max_range,
                                                const PersonFilterParams& params) const;

 protected:
  [[nodiscard]] ObservationModels& sensors() { return sensors_; }

 private:
  ObservationModels sensors_;
};

}  // namespace docent
