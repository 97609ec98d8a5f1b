#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/evaluation/truth_history.h"
#include "docent/geometry/pose2.h"
#include "docent/transport/bus.h"

namespace docent::evaluation {

/// A thing that a scenario puts up for a while; round.
struct WatchedThing {
  Point2 centre;        ///< [m], world
  double radius = 0.2;  ///< [m]
  double stands = 0.0;  ///< [s] from when it is put up; 0: until the end
};

/// When the robot's sensors saw things that a scenario put up and took away again, and when its live map had them: CSV
/// with time [s] since the first truth, number of the thing, what and from how far [m]. `what` is up, laser, cone
/// (sonar or infrared: something answered that was the thing), mapped; down, laser_gone (a beam went through where it
/// had stood), cone_gone (cones have looked over all of its edge, and met nothing), unmapped. Each comes once a thing.
/// Sensors are held to what is near: a laser to things within 6 m, a cone to those within 1.5 m. Where a person stands,
/// the map may be blocked at any time.
class ThingLog {
 public:
  /// @param base_from_sensor  mount of the sensor of that frame; nullopt: not one of this robot
  void watch(std::vector<WatchedThing> things, std::function<std::optional<Pose2>(std::string_view)> base_from_sensor);

  /// Topics that do not matter are passed over.
  void add(const transport::TopicInfo& topic, Time time, const std::shared_ptr<const void>& message);
  [[nodiscard]] const std::string& rows() const { return rows_; }
  [[nodiscard]] Result<void> save(const std::string& path) const;

 private:
  struct Thing {
    WatchedThing thing;
    std::optional<Time> up, down;
    bool laser = false, cone = false, mapped = false;
    bool laser_gone = false, cone_gone = false, unmapped = false;
    std::array<bool, 8> looked_over{};  ///< round its edge: a cone met nothing there since it is down
  };

  void see(const sensor_msgs::LaserScan& scan, Time time);
  void see(const sensor_msgs::Range& range, Time time);
  void take(const nav_msgs::OccupancyGrid& map, Time time);
  void take(const docent_msgs::LiveMapUpdate& update, Time time);
  void look_up(Time time);
  [[nodiscard]] std::optional<Pose2> pose_at(Time time) const;
  /// A cell where it stands is blocked, and no person is why.
  [[nodiscard]] bool is_in_map(const Thing& thing) const;
  void note(std::size_t thing, bool& once, const char* what, Time time, double from_m);

  std::vector<Thing> things_;
  std::function<std::optional<Pose2>(std::string_view)> base_from_sensor_;
  TruthHistory truth_;
  Time first_{};
  std::size_t put_up_ = 0;  ///< so many of them
  nav_msgs::OccupancyGrid map_;
  std::string rows_;
};

}  // namespace docent::evaluation
