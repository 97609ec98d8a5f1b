#include "docent/modules/exploration/people_seen.h"

#include <utility>

#include "docent/messages/conversions.h"

namespace docent::modules {
namespace {

/// Near what is drawn it is that; on floor with free floor all round it is not of the map; else nobody knows.
sensor_models::BeamOrigin origin_of(const OccupancyGrid& map, Point2 end) {
  constexpr int kNear = 3;  // cells
  const CellIndex at = map.frame.cell_at(end);
  bool is_free = true;
  for (int row = at.row - kNear; row <= at.row + kNear; ++row) {
    for (int column = at.column - kNear; column <= at.column + kNear; ++column) {
      if (map.is_occupied({column, row})) return sensor_models::BeamOrigin::map;
      is_free = is_free && map.is_free({column, row});
    }
  }
  return is_free ? sensor_models::BeamOrigin::not_map : sensor_models::BeamOrigin::unknown;
}

}  // namespace

docent_msgs::PersonBeams person_beams(const Keyframes::Look& look, const Pose2& map_from_odom,
                                      const OccupancyGrid& map) {
  docent_msgs::PersonBeams message;
  message.header = {to_message(look.stamp), "base_link"};
  message.localized = true;
  const Pose2& odom_from_base = look.odom_from_base;
  const Pose2 map_from_base = map_from_odom * odom_from_base;
  message.map_from_base = {map_from_base.x, map_from_base.y, map_from_base.theta.radians()};
  message.odom_from_base = {odom_from_base.x, odom_from_base.y, odom_from_base.theta.radians()};
  for (const sensor_models::SweepBeam& beam : look.sweep.beams) {
    const Point2 end = endpoint(beam);
    const auto origin = beam.no_return ? sensor_models::BeamOrigin::unknown : origin_of(map, map_from_base * end);
    message.bearings.push_back(static_cast<float>(beam.bearing));
    message.ranges.push_back(static_cast<float>(beam.no_return ? -beam.range : beam.range));
    message.origins.push_back(static_cast<std::uint8_t>(origin));
    if (origin != sensor_models::BeamOrigin::not_map) continue;
    message.x.push_back(static_cast<float>(end.x));
    message.y.push_back(static_cast<float>(end.y));
  }
  return message;
}

void PeopleSeen::note(const docent_msgs::People& in_odom) {
  constexpr double kWalked = 0.7;  // [m] from where somebody was seen first
  std::map<std::uint32_t, Track> tracks;
  walkers_.clear();
  for (const docent_msgs::Person& person : in_odom.people) {
    const Point2 at{static_cast<double>(person.x), static_cast<double>(person.y)};
    const auto known = tracks_.find(person.id);
    Track track = known == tracks_.end() ? Track{at, false} : known->second;
    track.has_walked = track.has_walked || distance(track.first, at) > kWalked;
    if (track.has_walked) walkers_.push_back(at);
    tracks[person.id] = track;
  }
  tracks_ = std::move(tracks);
}

}  // namespace docent::modules
