#include "docent/evaluation/run_logs/thing_log.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "docent/base/files.h"
#include "docent/messages/conversions.h"

namespace docent::evaluation {
namespace {

constexpr double kLaserReach = 6.0;   ///< [m]
constexpr double kConeReach = 1.5;    ///< [m]
constexpr double kNoise = 0.06;       ///< [m] that a range may be off
constexpr double kBeyond = 0.2;       ///< [m] behind the thing: a sensor that reads so far met nothing there
constexpr double kBlur = 0.1;         ///< [m]: cells so near the thing may be its
constexpr double kPerson = 0.5;       ///< [m] from a person's centre, within which a cell may be theirs
constexpr std::int8_t kBlocked = 65;  ///< as the field reads occupancy

}  // namespace

void ThingLog::watch(std::vector<WatchedThing> things,
                     std::function<std::optional<Pose2>(std::string_view)> base_from_sensor) {
  for (const WatchedThing& thing : things) things_.push_back({.thing = thing, .up = {}, .down = {}});
  base_from_sensor_ = std::move(base_from_sensor);
}

void ThingLog::note(std::size_t thing, bool& once, const char* what, Time time, double from_m) {
  if (std::exchange(once, true)) return;
  std::array<char, 96> row{};
  std::snprintf(row.data(), row.size(), "%.2f,%zu,%s,%.2f\n", to_seconds(time - first_), thing, what, from_m);
  rows_ += row.data();
}

std::optional<Pose2> ThingLog::pose_at(Time time) const {
  if (truth_.empty()) return std::nullopt;
  if (const auto pose = truth_.pose_at(time)) return pose;
  const auto* state = truth_.state_at(time);
  return state ? std::optional{true_pose(*state)} : std::nullopt;
}

void ThingLog::see(const sensor_msgs::LaserScan& scan, Time time) {
  const auto base_from_laser = base_from_sensor_(scan.header.frame_id);
  const auto world_from_base = pose_at(from_message(scan.header.stamp));
  if (!base_from_laser || !world_from_base) return;
  const Pose2 world_from_laser = *world_from_base * *base_from_laser;
  for (std::size_t i = 0; i < put_up_; ++i) {
    Thing& thing = things_[i];
    const Point2 centre = inverse(world_from_laser) * thing.thing.centre;
    const double away = norm(centre), radius = thing.thing.radius;
    if (away > kLaserReach) continue;
    for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
      const double range = static_cast<double>(scan.ranges[k]);
      if (std::isnan(range) || range < static_cast<double>(scan.range_min)) continue;
      const Point2 ray = unit(Angle::radians(static_cast<double>(scan.angle_min) +
                                             static_cast<double>(k) * static_cast<double>(scan.angle_increment)));
      const double along = dot(ray, centre), aside = std::abs(cross(ray, centre));
      if (along <= 0.0 || aside > 0.7 * radius) continue;
      if (!thing.down && std::abs(range - (along - std::sqrt(radius * radius - aside * aside))) < kNoise)
        note(i, thing.laser, "laser", time, away);
      if (thing.down && range > along + radius + kBeyond) note(i, thing.laser_gone, "laser_gone", time, away);
    }
  }
}

void ThingLog::see(const sensor_msgs::Range& range, Time time) {
  const auto base_from_sensor = base_from_sensor_(range.header.frame_id);
  const auto world_from_base = pose_at(from_message(range.header.stamp));
  if (!base_from_sensor || !world_from_base || std::isnan(range.range)) return;
  const Pose2 sensor_from_world = inverse(*world_from_base * *base_from_sensor);
  const double reading = static_cast<double>(range.range), half = 0.5 * static_cast<double>(range.field_of_view);
  const auto looks_at = [half](Point2 point) { return std::abs(std::atan2(point.y, point.x)) <= half; };
  for (std::size_t i = 0; i < put_up_; ++i) {
    Thing& thing = things_[i];
    const Point2 centre = sensor_from_world * thing.thing.centre;
    const double away = norm(centre), to_thing = away - thing.thing.radius;
    if (to_thing > kConeReach) continue;
    if (!thing.down && looks_at(centre) && std::abs(reading - to_thing) < kNoise)
      note(i, thing.cone, "cone", time, away);
    for (std::size_t k = 0; thing.down && k < thing.looked_over.size(); ++k) {
      const Angle bearing =
          Angle::degrees(360.0 / static_cast<double>(thing.looked_over.size()) * static_cast<double>(k));
      const Point2 point = sensor_from_world * (thing.thing.centre + thing.thing.radius * unit(bearing));
      if (looks_at(point) && norm(point) < kConeReach && reading > norm(point) + kBeyond) thing.looked_over[k] = true;
    }
    if (std::all_of(thing.looked_over.begin(), thing.looked_over.end(), [](bool looked) { return looked; }))
      note(i, thing.cone_gone, "cone_gone", time, away);
  }
}

bool ThingLog::is_in_map(const Thing& thing) const {
  const double cell = static_cast<double>(map_.info.resolution), reach = thing.thing.radius + kBlur;
  const auto width = static_cast<int>(map_.info.width), height = static_cast<int>(map_.info.height);
  const Point2 origin{map_.info.origin.position.x, map_.info.origin.position.y};
  const Point2 low = (1.0 / cell) * (thing.thing.centre - origin - Point2{reach, reach});
  const Point2 high = (1.0 / cell) * (thing.thing.centre - origin + Point2{reach, reach});
  const auto inside = [](double value, int size) {
    return std::clamp(static_cast<int>(std::floor(value)), 0, size - 1);
  };
  for (int row = inside(low.y, height); row <= inside(high.y, height); ++row) {
    for (int column = inside(low.x, width); column <= inside(high.x, width); ++column) {
      const Point2 centre = origin + cell * Point2{column + 0.5, row + 0.5};
      const auto& people = truth_.latest().people;
      const bool is_persons = std::any_of(people.begin(), people.end(), [centre](const auto& person) {
        return distance(centre, {static_cast<double>(person.x), static_cast<double>(person.y)}) < kPerson;
      });
      if (map_.data[static_cast<std::size_t>(row) * map_.info.width + static_cast<std::size_t>(column)] >= kBlocked &&
          distance(centre, thing.thing.centre) <= reach && !is_persons)
        return true;
    }
  }
  return false;
}

void ThingLog::look_up(Time time) {
  if (map_.data.empty() || truth_.empty()) return;
  for (std::size_t i = 0; i < put_up_; ++i) {
    Thing& thing = things_[i];
    if (!thing.down && !thing.mapped && is_in_map(thing)) note(i, thing.mapped, "mapped", time, 0.0);
    if (thing.down && !thing.unmapped && !is_in_map(thing)) note(i, thing.unmapped, "unmapped", time, 0.0);
  }
}

void ThingLog::take(const nav_msgs::OccupancyGrid& map, Time time) {
  map_ = map;
  look_up(time);
}

void ThingLog::take(const docent_msgs::LiveMapUpdate& update, Time time) {
  const auto left = static_cast<std::size_t>(update.x), low = static_cast<std::size_t>(update.y);
  if (map_.data.empty() || left + update.width > map_.info.width || low + update.height > map_.info.height) return;
  for (std::size_t row = 0; row < update.height; ++row)
    std::copy_n(update.data.begin() + static_cast<std::ptrdiff_t>(row * update.width), update.width,
                map_.data.begin() + static_cast<std::ptrdiff_t>((low + row) * map_.info.width + left));
  look_up(time);
}

void ThingLog::add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message) {
  if (things_.empty()) return;
  const auto is = [name = std::string_view{topic.name}](const auto& wanted) { return name == wanted.name; };
  const auto as = [&message]<class T>(const Topic<T>& /*wanted*/) -> const T& {
    return *static_cast<const T*>(message.get());
  };
  if (is(topics::kTrueState)) {
    if (truth_.empty()) first_ = time;
    truth_.add(std::static_pointer_cast<const docent_msgs::TrueState>(message));
    for (std::size_t i = 0; i < put_up_; ++i) {
      Thing& thing = things_[i];
      if (thing.down || thing.thing.stands <= 0.0 || to_seconds(time - *thing.up) < thing.thing.stands) continue;
      thing.down = time;
      bool once = false;
      note(i, once, "down", time, 0.0);
    }
  } else if (is(topics::kTrueOffer)) {
    if (as(topics::kTrueOffer).kind != "stool" || put_up_ == things_.size()) return;
    things_[put_up_].up = time;
    bool once = false;
    note(put_up_++, once, "up", time, 0.0);
  } else if (is(topics::kLiveMap)) {
    take(as(topics::kLiveMap), time);
  } else if (is(topics::kLiveMapUpdate)) {
    take(as(topics::kLiveMapUpdate), time);
  } else if (is(topics::kSonar)) {
    see(as(topics::kSonar), time);
  } else if (is(topics::kInfrared)) {
    see(as(topics::kInfrared), time);
  } else {
    for (const auto* scan : {&topics::kScanFront, &topics::kScanRear, &topics::kScanLeft, &topics::kScanRight})
      if (is(*scan)) see(as(*scan), time);
  }
}

Result<void> ThingLog::save(const std::string& path) const {
  return write_file_atomically(path, "time,thing,what,from\n" + rows_);
}

}  // namespace docent::evaluation
