#pragma once

#include <optional>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/geometry/pose2.h"
#include "docent/grid/occupancy_grid.h"

namespace docent::turtlebot {

/// Something that its scanner does not see: low, or missing floor.
struct Low {
  Point2 middle;
  double radius = 0.0;  ///< [m]
};

struct Settings {
  OccupancyGrid world;
  Pose2 map_from_dock;  ///< where the robot stands in it
  Pose2 map_from_robot;
  bool begins_docked = true;
  std::uint64_t seed = 1;
};

/// How it behaves, by its makers' documents: it obeys a velocity for half a second, drives 0.306 m/s at most, changes
/// the speed of its wheels by 0.9 m/s2, backs off by itself where it touches something or finds a cliff, backs no
/// farther than it has come, and obeys no velocity while it docks or undocks. One thread.
class Body {
 public:
  static constexpr double kRadius = 0.171;  // [m]
  enum class Behaviour { none, dock, undock, reflex };
  struct Hazard {
    std::uint8_t type;
    std::string frame;
  };

  explicit Body(const Settings& settings);

  void command(double linear, double angular);
  /// @returns whether it begins: it stands in its dock already, or is too far from it
  bool dock();
  bool undock();
  void step(double dt);

  [[nodiscard]] Pose2 map_from_robot() const { return truth_; }
  [[nodiscard]] Pose2 odom_from_robot() const { return odometry_; }
  [[nodiscard]] double linear() const { return linear_; }
  [[nodiscard]] double angular() const { return angular_; }
  [[nodiscard]] bool is_docked() const { return is_docked_; }
  [[nodiscard]] bool sees_dock() const;
  [[nodiscard]] Behaviour behaviour() const { return behaviour_; }
  [[nodiscard]] std::vector<Hazard> hazards() const;
  [[nodiscard]] std::vector<float> scan(int beams, double mounted_x, double mounted_yaw);

  double battery = 0.9;  ///< share
  bool is_lifted = false;
  std::vector<Low> boxes;    ///< that it bumps into
  std::vector<Low> holes;    ///< that its cliff sensors find
  int bumps = 0;             ///< that it has met something and backs off by itself
  int edges = 0;             ///< likewise a cliff
  double commanded_s = 0.0;  ///< [s] that it was told to move while it moved by itself

 private:
  void steer(double linear, double angular, double dt);
  void behave(double dt);
  bool drive_to(Point2 place, double speed, double dt);
  bool turn_to(Angle heading, double dt);
  [[nodiscard]] bool is_free(Point2 at) const;
  /// [rad] bearings of what is nearer to its rim than that [m].
  [[nodiscard]] std::vector<double> touches(double within) const;
  [[nodiscard]] std::vector<std::string> cliffs() const;

  Settings settings_;
  Rng rng_;
  Pose2 truth_, odometry_;
  double linear_ = 0.0, angular_ = 0.0;
  double wanted_linear_ = 0.0, wanted_angular_ = 0.0;
  double since_command_ = 1e9;
  double backed_ = 0.0;  ///< [m] that it may still drive back
  bool is_docked_;
  Behaviour behaviour_ = Behaviour::none;
  int phase_ = 0;
  double left_ = 0.0;  ///< [m] or [s] of a phase
  Angle target_;
};

}  // namespace docent::turtlebot
