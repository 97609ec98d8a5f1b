#pragma once

#include <optional>
#include <span>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/messages/docent_messages.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::modules {

/// The sweep of a moment, where it was taken, and which of its beams may have ended on people.
struct SeenPeople {
  Time stamp{};
  bool is_localized = false;
  std::optional<Pose2> map_from_base;  ///< none: there is no place that is likelier than others
  Pose2 odom_from_base;
  const sensor_models::RangeSweep& sweep;              ///< about the robot's centre
  std::span<const sensor_models::BeamOrigin> origins;  ///< [beams of the sweep]
  std::span<const Point2> ends;                        ///< [m], base: of what the map does not hold
};

/// Beams without a return have negative ranges. O(beams). @pre as many origins as beams
[[nodiscard]] docent_msgs::PersonBeams person_beams_message(const SeenPeople& seen);

}  // namespace docent::modules
