#include "docent/modules/map_module.h"

#include <array>
#include <cmath>

#include "docent/mapping/occupancy/live_map.h"
#include "docent/modules/message_fitness.h"
#include "docent/modules/pose_tracker.h"

namespace docent {
namespace {

constexpr Duration kFullMapPeriod = std::chrono::seconds{10};
constexpr Duration kStaleAfter = std::chrono::seconds{1};

nav_msgs::MapMetaData to_message(const GridFrame& frame, Time now) {
  nav_msgs::MapMetaData info;
  info.map_load_time = docent::to_message(now);
  info.resolution = static_cast<float>(frame.resolution);
  info.width = static_cast<std::uint32_t>(frame.columns);
  info.height = static_cast<std::uint32_t>(frame.rows);
  info.origin = docent::to_message(Pose2{frame.origin.x, frame.origin.y, {}});
  return info;
}

class MapModule final : public Module {
 public:
  MapModule(const ModuleContext& context, const LiveMapParams& params)
      : bus_{context.bus},
        live_{context.museum.map, params},
        base_from_laser_{context.config.body().scan_front.base_from_sensor(),
                         context.config.body().scan_rear.base_from_sensor()},
        live_map_{bus_.publisher(topics::kLiveMap)},
        updates_{bus_.publisher(topics::kLiveMapUpdate)} {
    nav_msgs::OccupancyGrid map;
    map.header = {docent::to_message(bus_.now()), "map"};
    map.info = to_message(context.museum.map.frame, bus_.now());
    map.data = context.museum.map.cells;
    bus_.publisher(topics::kStaticMap).publish(std::move(map));
    publish_full();

    bus_.subscribe<docent_msgs::Belief>(topics::kBelief, [this](const auto& belief) { pose_.on_belief(belief); });
    bus_.subscribe<nav_msgs::Odometry>(topics::kOdometry,
                                       [this](const auto& odometry) { pose_.on_odometry(odometry); });
    bus_.subscribe<sensor_msgs::LaserScan>(topics::kScanFront, [this](const auto& scan) { take(0, scan); });
    bus_.subscribe<sensor_msgs::LaserScan>(topics::kScanRear, [this](const auto& scan) { take(1, scan); });
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
    Time received{};
  };

  void take(std::size_t laser, const sensor_msgs::LaserScan& scan) {
    if (is_fit(scan)) sights_[laser] = {scan, bus_.now()};
  }

  void look() {
    if (!pose_.localized()) return;
    const Time now = bus_.now();
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      const auto& scan = sights_[i].scan;
      const auto map_from_base = pose_.map_from_base_at(from_message(scan.header.stamp));
      if (scan.ranges.empty() || now - sights_[i].received > kStaleAfter || !map_from_base) continue;
      const Pose2 map_from_laser = *map_from_base * base_from_laser_[i];
      endpoints_.clear();
      for (std::size_t k = 0; k < scan.ranges.size(); ++k) {
        const float range = scan.ranges[k];
        if (!std::isfinite(range) || range < scan.range_min) continue;
        const Angle bearing = Angle::radians(static_cast<double>(scan.angle_min) +
                                             static_cast<double>(k) * static_cast<double>(scan.angle_increment));
        endpoints_.push_back(map_from_laser * (static_cast<double>(range) * unit(bearing)));
      }
      live_.look(map_from_laser.position(), endpoints_, now);
    }
    publish_changes();
  }

  void publish_changes() {
    const auto changes = live_.take_changes();
    if (!changes) return;
    changed_since_full_ = true;
    docent_msgs::LiveMapUpdate update;
    update.header = {docent::to_message(bus_.now()), "map"};
    update.base = docent::to_message(full_stamp_);
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
    map.header = {docent::to_message(full_stamp_), "map"};
    map.info = to_message(live_.frame(), full_stamp_);
    map.data.resize(live_.frame().size());
    for (std::size_t i = 0; i < map.data.size(); ++i) map.data[i] = live_.cell(i);
    live_map_.publish(std::move(map));
  }

  Bus& bus_;
  LiveMap live_;
  std::array<Pose2, 2> base_from_laser_;
  Publisher<nav_msgs::OccupancyGrid> live_map_;
  Publisher<docent_msgs::LiveMapUpdate> updates_;
  PoseTracker pose_;
  std::array<Sight, 2> sights_;  ///< newest sweeps
  std::vector<Point2> endpoints_;
  Time full_stamp_{};
  std::uint32_t number_ = 0;
  bool changed_since_full_ = false;
};

}  // namespace

Result<std::unique_ptr<Module>> make_map(const ModuleContext& context) {
  auto params = context.config.section<LiveMapParams>("map");
  if (!params) return tl::unexpected<Error>(params.error());
  return std::make_unique<MapModule>(context, *params);
}

Result<ParameterRows> parameters_of_map(const RobotConfig& config) {
  return list_parameters<LiveMapParams>(config, "map");
}

}  // namespace docent
