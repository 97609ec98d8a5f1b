#pragma once

#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/expected_sweeps/range_law.h"
#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"

namespace docent::collision_avoidance {

/// What one sensor of a ring, sonar or infrared, heard last.
struct RingEcho {
  Time stamp;
  Pose2 odom_from_sensor;
  double field_of_view = 0.0;  ///< [rad]
  double range = 0.0;          ///< [m] to what answered
};

/// The last echo of each sensor of all rings.
class RingEchoes {
 public:
  /// @param ring  number of the ring @param reading  one without an echo takes the sensor's last one away
  void hear(int ring, std::size_t index, const SonarReading& reading, const Pose2& odom_from_base);
  [[nodiscard]] const std::vector<RingEcho>& all() const { return echoes_; }

 private:
  std::map<std::pair<int, std::size_t>, std::size_t> places_;
  std::vector<RingEcho> echoes_;  ///< range 0: none
};

struct RingCheckParams {
  double together = 0.13;      ///< [s] between an echo and the sweep that it is compared with: who walks goes 0.2 m
  double memory = 0.9;         ///< [s] in which all sensors of a slow ring have spoken twice
  double least_range = 0.1;    ///< [m] nearer, an infrared sensor folds over
  double most_range = 3.0;     ///< [m] farther echoes are of anything
  double near = 1.0;           ///< [m] farther echoes than this may be of low things and glass
  double aside = 0.25;         ///< [rad] beyond the nominal cone sound still comes back from
  double noise = 0.1;          ///< [m] between an echo and a beam that met the same,
  double per_metre = 0.05;     ///< [m/m] and more with the distance: the speed of sound, and calibration
  int least = 6;               ///< sensors that follow a law,
  double least_span = 1.2;     ///< [rad] and look in such different directions: no bench is so wide
  double share = 0.65;         ///< of all sensors that met what the laser meets
  double most_agree = 0.3;     ///< and at most so many agree with the laser
  double least_offset = 0.25;  ///< [m] less is clothes, and where the ring is said to be
  double least_factor = 1.3;
  double agrees = 0.7;   ///< of the sensors, and
  int least_agree = 6;   ///< so many agree: the laser is in order
  double differs = 2.0;  ///< tolerances between what a law and the truth would read: else nothing contradicts it
};

/// Whether sonars and infrared sensors meet things where a laser says that they are. They see more than it: glass and
/// low things make one echo or another shorter. But where most of them all round are shorter by one law, a factor or an
/// offset, it is the laser's. What they say to be farther, they may have missed.
class RingCheck {
 public:
  explicit RingCheck(const RingCheckParams& params = {}) : params_{params} {}

  struct Finding {
    bool in_order = false;
    std::optional<RangeLaw> too_long{};  ///< by this law
  };
  /// One sweep. O(echoes * samples of a cone).
  [[nodiscard]] Finding add(const SweepView& view, std::span<const RingEcho> echoes);
  /// Whether the sensors of the last moments have seen the laser in order where it would not be by this law.
  /// @param since  no older sweeps count
  [[nodiscard]] bool contradicts(const RangeLaw& law, Time since) const;
  /// Share of the sensors that agree; nullopt: too few have met something.
  [[nodiscard]] std::optional<double> agreement() const;
  /// Where the ring hears something near and the laser of this sweep says that nothing is there, in the whole cone: [m]
  /// in the laser's frame.
  [[nodiscard]] std::vector<Point2> unanswered(const SweepView& view, std::span<const RingEcho> echoes) const;

 private:
  struct Vote {
    Time stamp;
    double bearing = 0.0;  ///< [rad], sensor frame
    double range = 0.0;    ///< [m] of the echo, from the laser
    double reading = 0.0;  ///< [m] of the laser, the nearest in the cone
    bool agrees = false;
    bool is_shorter = false;  ///< the laser says that it is nearer
  };
  using Votes = std::vector<Vote>;  ///< [echoes] the last of each sensor
  struct Agreement {
    int compared = 0;
    int agree = 0;
  };
  [[nodiscard]] static Agreement agreement_of(const Votes& votes);
  void collect(const SweepView& view, std::span<const RingEcho> echoes);
  [[nodiscard]] std::optional<Vote> vote_of(const RingEcho& echo, const SweepView& view) const;
  [[nodiscard]] std::optional<RangeLaw> law() const;
  [[nodiscard]] double span_of(const RangeLaw& law) const;
  [[nodiscard]] bool follows(const Vote& vote, const RangeLaw& law) const;

  RingCheckParams params_;
  Votes votes_;
};

}  // namespace docent::collision_avoidance
