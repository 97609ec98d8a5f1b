#include "docent/modules/perception/map_module.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/collision_avoidance/body/outline_distance.h"
#include "docent/collision_avoidance/obstacle_field/sweep_geometry.h"
#include "docent/collision_avoidance/watches/tactile_watch.h"
#include "docent/geometry/point_transform.h"
#include "docent/mapping/occupancy/live_map.h"
#include "docent/modules/shared/grid_message.h"
#include "docent/modules/shared/pose_tracker.h"
#include "docent/modules/shared/scanners.h"
#include "docent/modules/shared/sensor_time.h"

namespace docent::modules {
namespace {

constexpr Duration kFullMapPeriod = std::chrono::seconds{10};
constexpr Duration kStaleSight = std::chrono::seconds{1};

class MapModule final : public Module {
 public:
  MapModule(const ModuleContext& context, const mapping::LiveMapParams& params, collision_avoidance::Outline outline)
      : bus_{context.bus},
        body_{context.config.body()},
        outline_{std::move(outline)},
        live_{context.museum.map, params, context.museum.hazard_polygons()},
        base_from_laser_{mounts_of(body_.scanners)},
        sights_(base_from_laser_.size()),
        live_map_{bus_.publisher(topics::kLiveMap)},
        updates_{bus_.publisher(topics::kLiveMapUpdate)},
        pose_{reach_of(body_)} {
    nav_msgs::OccupancyGrid map;
    map.header = {to_message(bus_.now()), "map"};
    map.info = info_of(context.museum.map.frame, bus_.now());
    map.data = context.museum.map.cells;
    bus_.publisher(topics::kStaticMap).publish(std::move(map));
    publish_full();

    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { pose_.on_belief(belief); });
    bus_.subscribe<nav_msgs::Odometry>(
        topics::kOdometry, [this](const auto& odometry) { pose_.on_odometry(odometry, sensor_time_.of(odometry)); });
    subscribe_scanners(bus_, context.config.body(), [this](std::size_t i, const auto& scan, const auto& place) {
      base_from_laser_[i] = place.base_from_sensor;
      take(i, scan, place);
    });
    bus_.subscribe<sensor_msgs::Range>(topics::kSonar, [this](const auto& range) {
      if (const auto index = body_.sonar_of(range.header.frame_id))
        take(range, body_.base_from_sonar(*index),
             [this](const mapping::ConeReading& reading) { live_.add_sonar(reading, laser_looks(), bus_.now()); });
    });
    bus_.subscribe<sensor_msgs::Range>(topics::kInfrared, [this](const auto& range) {
      if (const auto index = body_.infrared_of(range.header.frame_id))
        take(range, body_.base_from_infrared(*index),
             [this](const mapping::ConeReading& reading) { live_.add_infrared(reading, laser_looks(), bus_.now()); });
    });
    bus_.subscribe<docent_msgs::Tactile>(topics::kTactile, [this](const auto& tactile) { feel(tactile); });
    bus_.subscribe<docent_msgs::ObstacleLines>(topics::kObstacleLines, [this](const auto& lines) { see(lines); });
    bus_.every(seconds(params.period), [this] { look(); });
    bus_.every(kFullMapPeriod, [this] {
      live_.forget(bus_.now());
      if (changed_since_full_) publish_full();
    });
  }

  [[nodiscard]] ModuleHealth health() const override {
    if (!pose_.localized()) return {"degraded", "the live map waits for a position"};
    return {};
  }

 private:
  struct Sight {
    sensor_msgs::LaserScan scan;
    collision_avoidance::BeamDirections directions;
    Time received{};
    Time stamp{};                   ///< local time
    Pose2 map_from_laser;           ///< when it was taken
    std::vector<Point2> endpoints;  ///< [m], map
    bool is_placed = false;         ///< the two above are of this scan
  };

  void take(std::size_t laser, const sensor_msgs::LaserScan& scan, const ScannerPlace& place) {
    sights_[laser].scan = scan;
    sights_[laser].received = bus_.now();
    sights_[laser].stamp = sensor_time_.of(laser, scan, place);
    sights_[laser].is_placed = false;
  }

  /// @returns false where its pose is not known, or nothing was seen lately
  bool place(std::size_t laser) {
    Sight& sight = sights_[laser];
    const auto& scan = sight.scan;
    if (scan.ranges.empty() || bus_.now() - sight.received > kStaleSight) return false;
    if (sight.is_placed) return true;
    const auto map_from_base = pose_.map_from_base_at(sight.stamp);
    if (!map_from_base) return false;
    sight.map_from_laser = *map_from_base * base_from_laser_[laser];
    sight.endpoints.clear();
    const auto& directions = sight.directions.of(static_cast<double>(scan.angle_min),
                                                 static_cast<double>(scan.angle_increment), scan.ranges.size());
    const PointTransform map_from_laser{sight.map_from_laser};
    for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
      const float range = scan.ranges[k];
      if (!std::isfinite(range) || range < scan.range_min) continue;
      sight.endpoints.push_back(map_from_laser * (static_cast<double>(range) * directions[k]));
    }
    return sight.is_placed = true;
  }

  void look() {
    if (!pose_.localized()) return;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (place(i))
        live_.look(sights_[i].map_from_laser.position(), sights_[i].endpoints, bus_.now(),
                   static_cast<double>(sights_[i].scan.range_max));
    }
    publish_changes();
  }

  /// What the lasers see at present.
  std::span<const mapping::LaserLook> laser_looks() {
    looks_.clear();
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (!place(i)) continue;
      const auto& scan = sights_[i].scan;
      const double field = static_cast<double>(scan.angle_increment) * static_cast<double>(scan.ranges.size());
      looks_.push_back({sights_[i].map_from_laser, scan.angle_min, field, sights_[i].endpoints});
    }
    return looks_;
  }

  template <class Add>
  void take(const sensor_msgs::Range& range, const Pose2& base_from_sensor, const Add& add) {
    const std::string ring = range.radiation_type == 0 ? "sonars" : "infrared";
    const auto map_from_base = pose_.map_from_base_at(sensor_time_.of(ring, range.header));
    if (!pose_.localized() || !map_from_base) return;
    add(mapping::ConeReading{*map_from_base * base_from_sensor, range.field_of_view, range.max_range, range.range});
  }

  void feel(const docent_msgs::Tactile& tactile) {
    const auto map_from_base = pose_.map_from_base_at(sensor_time_.of("tactile", tactile.header));
    if (!pose_.localized() || !map_from_base || tactile.segments.empty()) return;
    const double step = 2.0 * std::numbers::pi / static_cast<double>(tactile.segments.size());
    for (std::size_t i = 0; i < tactile.segments.size(); ++i) {
      const Angle bearing = Angle::radians(step * static_cast<double>(i));
      const double reach = outline_.empty() ? body_.radius : outline_.radius_at(bearing);
      if (tactile.segments[i] == 0 || tactile.segments[i] == collision_avoidance::TactileWatch::kNoReading) continue;
      live_.add_touch(*map_from_base * (reach * unit(bearing)), unit(map_from_base->theta + bearing), laser_looks(),
                      bus_.now());
    }
    live_.stand(map_from_base->position(), outline_.empty() ? body_.radius : norm(outline_.nearest({})));
  }

  void see(const docent_msgs::ObstacleLines& message) {
    const auto map_from_base = pose_.map_from_base_at(sensor_time_.of(message.source, message.header));
    if (!pose_.localized() || !map_from_base) return;
    std::vector<Segment> lines;
    for (const auto& line : message.lines)
      lines.push_back({*map_from_base * Point2{line.x1, line.y1}, *map_from_base * Point2{line.x2, line.y2}});
    live_.add_lines(message.source, map_from_base->position(), lines, laser_looks(), bus_.now());
  }

  void publish_changes() {
    const auto changes = live_.take_changes();
    if (!changes) return;
    changed_since_full_ = true;
    docent_msgs::LiveMapUpdate update;
    update.header = {to_message(bus_.now()), "map"};
    update.base = to_message(full_stamp_);
    update.number = ++number_;
    update.x = changes->low.column;
    update.y = changes->low.row;
    update.width = static_cast<std::uint32_t>(changes->high.column - changes->low.column + 1);
    update.height = static_cast<std::uint32_t>(changes->high.row - changes->low.row + 1);
    for (int row = changes->low.row; row <= changes->high.row; ++row) {
      for (int column = changes->low.column; column <= changes->high.column; ++column) {
        update.data.push_back(live_.cell(live_.frame().index({column, row})));
      }
    }
    updates_.publish(std::move(update));
  }

  void publish_full() {
    full_stamp_ = bus_.now();
    number_ = 0;
    changed_since_full_ = false;
    (void)live_.take_changes();
    nav_msgs::OccupancyGrid map;
    map.header = {to_message(full_stamp_), "map"};
    map.info = info_of(live_.frame(), full_stamp_);
    map.data.resize(live_.frame().size());
    for (std::size_t i = 0; i < map.data.size(); ++i) map.data[i] = live_.cell(i);
    live_map_.publish(std::move(map));
  }

  transport::Bus& bus_;
  robot::RobotBody body_;
  collision_avoidance::Outline outline_;  ///< empty: a disc
  mapping::LiveMap live_;
  std::vector<Pose2> base_from_laser_;  ///< [scanners]
  std::vector<Sight> sights_;           ///< [scanners] newest sweeps
  transport::Publisher<nav_msgs::OccupancyGrid> live_map_;
  transport::Publisher<docent_msgs::LiveMapUpdate> updates_;
  SensorTime sensor_time_{bus_};
  PoseTracker pose_;
  std::vector<mapping::LaserLook> looks_;
  Time full_stamp_{};
  std::uint32_t number_ = 0;
  bool changed_since_full_ = false;
};

}  // namespace

Result<std::unique_ptr<Module>> make_map(const ModuleContext& context) {
  auto params = context.config.section<mapping::LiveMapParams>("map");
  if (!params) return tl::unexpected<Error>(params.error());
  auto outline = collision_avoidance::Outline::of_body(context.config.body().outline);
  if (!outline) return tl::unexpected<Error>(outline.error());
  return std::make_unique<MapModule>(context, *params, std::move(*outline));
}

Result<robot::ParameterRows> parameters_of_map(const robot::RobotConfig& config) {
  return robot::list_parameters<mapping::LiveMapParams>(config, "map");
}

}  // namespace docent::modules
