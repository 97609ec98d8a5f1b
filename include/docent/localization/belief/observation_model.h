#pragma once

#include <memory>
#include <span>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::localization {

/// A pose that the belief holds likely.
struct LikelyPose {
  Pose2 map_from_robot;  ///< where it may be
  double mass = 0.0;     ///< normalised over all of them
};

/// The moment of an update.
struct ObservationMoment {
  Time time;                           ///< of the sweep
  Pose2 odom_from_robot;               ///< then
  std::span<const LikelyPose> likely;  ///< before the update; empty while the belief is too wide for filters
};

/// p(s | l) of a sensor beside the lasers, [Rhino1999] eq. 2 to 4: sonars, a camera that looks at the ceiling, a
/// landmark by its bearing. Each keeps what it has measured, filters it in its own way and has a model of its own. The
/// belief takes in what it says as a cost: how far ln p stays below the best that any pose could give.
class ObservationModel {
 public:
  ObservationModel() = default;
  ObservationModel(const ObservationModel&) = delete;
  ObservationModel& operator=(const ObservationModel&) = delete;
  virtual ~ObservationModel() = default;

  /// Takes what was measured since the last update and is fresh at that moment; false: there is nothing to say.
  virtual bool observe(const ObservationMoment& moment) = 0;
  /// Adds to `nats` [poses] the cost >= 0 [nat] of each pose, tempered to what a full update may count.
  virtual void add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const = 0;
  /// Cost [nat] of a pose of which nothing is known, eq. 4 of [Markov1998]: of states that are not asked one by one.
  [[nodiscard]] virtual double mean_cost() const = 0;
};

/// What asking them costs a pose, in units of LocalizerParams::work_per_second: tens of nanoseconds.
inline constexpr double kWorkOfOthers = 40.0;

/// All sensors beside the lasers. The localizers see this, and no sensor.
class ObservationModels {
 public:
  /// One more, after the others.
  void add(std::shared_ptr<ObservationModel> model) { models_.push_back(std::move(model)); }
  [[nodiscard]] bool none() const { return models_.empty(); }  ///< nothing was added

  /// Asks all of them, in the order in which they were added; whether any has something to say.
  bool observe(const ObservationMoment& moment);
  /// An update without them.
  void pass_over() { speaking_.clear(); }
  /// Sums over those that had.
  void add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const;
  [[nodiscard]] double mean_cost() const;                        ///< [nat] sum of theirs
  [[nodiscard]] double cost(const Pose2& map_from_robot) const;  ///< [nat] of a single pose

 private:
  std::vector<std::shared_ptr<ObservationModel>> models_;
  std::vector<const ObservationModel*> speaking_;
};

}  // namespace docent::localization
