#include "docent/modules/shared/person_beams.h"

#include <cstddef>
#include <cstdint>

#include "docent/messages/conversions.h"

namespace docent::modules {

docent_msgs::PersonBeams person_beams_message(const SeenPeople& seen) {
  docent_msgs::PersonBeams message;
  message.header = {to_message(seen.stamp), "base_link"};
  message.localized = seen.is_localized;
  if (const auto& pose = seen.map_from_base) message.map_from_base = {pose->x, pose->y, pose->theta.radians()};
  const Pose2& odom_from_base = seen.odom_from_base;
  message.odom_from_base = {odom_from_base.x, odom_from_base.y, odom_from_base.theta.radians()};
  const auto& beams = seen.sweep.beams;
  message.bearings.reserve(beams.size());
  message.ranges.reserve(beams.size());
  message.origins.reserve(beams.size());
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const sensor_models::SweepBeam& beam = beams[i];
    message.bearings.push_back(static_cast<float>(beam.bearing));
    message.ranges.push_back(static_cast<float>(beam.no_return ? -beam.range : beam.range));
    message.origins.push_back(static_cast<std::uint8_t>(seen.origins[i]));
  }
  for (const Point2 end : seen.ends) {
    message.x.push_back(static_cast<float>(end.x));
    message.y.push_back(static_cast<float>(end.y));
  }
  return message;
}

}  // namespace docent::modules
