#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include "docent/base/time.h"
#include "docent/collision_avoidance/obstacle_field/obstacle_memory.h"
#include "docent/geometry/pose2.h"

namespace docent::collision_avoidance {

/// No answer: nothing there within reach, or so the scanner says.
inline constexpr float kNoAnswer = std::numeric_limits<float>::infinity();

/// Where the samples of a scanner look: computed once, as long as its sweeps keep their form.
struct SampleRays {
  double first_bearing = 0.0;  ///< [rad], sensor frame
  double bearing_step = 0.0;   ///< [rad]
  std::vector<Point2> units;   ///< [samples]
};

/// A sweep thinned to some samples, for comparisons with other sweeps. Where it is thinned, a sample stands for the
/// beams round it.
struct SweepView {
  Time stamp;
  Pose2 odom_from_sensor;
  double first_bearing = 0.0;  ///< [rad], sensor frame
  double bearing_step = 0.0;   ///< [rad] between samples
  double min_range = 0.0;      ///< [m]
  double max_range = 0.0;      ///< [m]
  std::vector<float> ranges;   ///< [samples] [m]; kNoAnswer; NaN: no reading
  std::vector<float>
      nearest;  ///< [samples] [m] of a sample and the two beside it; kNoAnswer where none of them answers
  std::vector<float> farthest;             ///< [samples] [m] likewise; kNoAnswer where one of them does not answer
  int answers = 0;                         ///< samples that met something
  std::shared_ptr<const SampleRays> rays;  ///< of the samples

  /// The sample that looks nearest to a place, sensor frame; negative: none does.
  [[nodiscard]] long sample_to(Point2 in_sensor) const;
  /// [m], sensor frame, of a sample that met something.
  [[nodiscard]] Point2 place(std::size_t sample) const {
    return static_cast<double>(ranges[sample]) * rays->units[sample];
  }
  [[nodiscard]] bool met(std::size_t sample) const {
    return ranges[sample] < kNoAnswer;  // false for NaN
  }
};

/// @param most  samples @param like  the scanner's last sweep: its rays, if they are the same
[[nodiscard]] SweepView view_of(const SensorSweep& sweep, const Pose2& odom_from_sensor, std::size_t most = 180,
                                const std::shared_ptr<const SampleRays>& like = nullptr);

/// A view of what is wider than a person and straight: the rest is "no reading". O(samples * log samples), mostly.
[[nodiscard]] SweepView walls_of(const SweepView& view);

/// The ranges [m] that the samples of `like` would have if what `seen` met stood still: [samples], NaN where `seen`
/// says nothing of a sample.
/// @param like_from_seen  from the sensor then to the sensor now
/// O(samples).
void expect(const SweepView& seen, const Pose2& like_from_seen, const SweepView& like, std::vector<float>& expected);

}  // namespace docent::collision_avoidance
