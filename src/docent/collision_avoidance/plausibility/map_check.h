#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/range_law.h"
#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::collision_avoidance {

struct MapCheckParams {
  RangeLawParams law{.noise = 0.12, .least = 20};  ///< noise: the map's cells, and the pose
  double between = 0.2;                            ///< [s] between comparisons
  std::size_t every = 2;                           ///< sample: neighbours tell little more
  double least_mass = 0.5;                         ///< of the belief at the place that is asked
  double longest = 3.0;                            ///< [s] since the belief
  double off = 0.6;            ///< [m] that the place may be wrong: does that explain the readings as well?
  double off_step = 0.15;      ///< [m] tried
  double off_turn = 0.17;      ///< [rad] 10 degrees likewise
  double as_well = 0.15;       ///< of the samples fewer are still as well explained
  double fits = 0.6;           ///< of the samples that answer are as the map has them: the place is right
  int least_answers = 12;      ///< of them, for that
  double nothing_near = 0.1;   ///< of the samples at most meet anything within reach: a silent sweep is no wonder
  int sure = 2;                ///< comparisons in succession
  double stands = 0.01;        ///< [m] from where the map was looked at last: a robot that stands need not look again,
  double stands_turn = 0.005;  ///< [rad] likewise
};

/// What a map surely knows to be a wall, for the checks of all scanners; what is neither free nor a wall is passed
/// through. @param map  null: null. O(cells).
[[nodiscard]] std::shared_ptr<const sensor_models::RayCaster> known_walls(
    const std::shared_ptr<const OccupancyGrid>& map);

/// What the map says of a scanner's sweep where the robot believes to stand. The place is not taken for granted: ranges
/// that are wrong by a law are told from a wrong place by trying places near by.
class MapCheck {
 public:
  /// @param walls  `known_walls` of the map; null: there is none
  explicit MapCheck(std::shared_ptr<const sensor_models::RayCaster> walls = nullptr, const MapCheckParams& params = {});

  [[nodiscard]] bool has_map() const { return walls_ != nullptr; }
  /// Where the robot believes to be. @param mass  of the belief there, 0..1
  void believe(Time stamp, const Pose2& map_from_odom, double mass);

  /// What one sweep says.
  struct Finding {
    bool is_known = false;          ///< there is a place, and the map knows it; else nothing else holds
    bool in_order = false;          ///< the sweep is as the map has it
    std::optional<RangeLaw> lie{};  ///< what holds for its ranges instead
    bool is_nothing_near = false;   ///< the map has nothing within this scanner's reach
    bool fits = false;              ///< what answers is as the map has it, so that silence can be judged
  };
  /// nullopt: it is not time for another comparison. O(samples), and for what may be a lie
  /// O(samples * places).
  [[nodiscard]] std::optional<Finding> compare(const SweepView& view);
  /// [samples] of the last comparison: [m]; kNoAnswer: nothing within reach; NaN: the map does not say.
  [[nodiscard]] const std::vector<float>& expected() const { return expected_; }

 private:
  /// [map] the directions of some samples; of the others nothing.
  [[nodiscard]] std::vector<Point2> rays_of(const SweepView& view, Angle heading, std::size_t every) const;
  void expect_at(const SweepView& view, Point2 in_map, std::span<const Point2> rays, std::size_t every,
                 std::vector<float>& expected) const;
  /// The last comparison was made from there, with such samples.
  [[nodiscard]] bool is_expected_from(const SweepView& view, const Pose2& map_from_sensor) const;
  [[nodiscard]] bool is_wrong_place(const SweepView& view, const Pose2& map_from_sensor, const RangeLaw& law) const;

  MapCheckParams params_;
  std::shared_ptr<const sensor_models::RayCaster> walls_;
  double half_cell_ = 0.0;  ///< [m] from a wall's outline to where the map has it
  std::optional<Pose2> map_from_odom_;
  Time believed_{};
  Time compared_{};
  /// Where `expected_` was looked for.
  struct Expected {
    Pose2 map_from_sensor;
    double first_bearing = 0.0;
    double bearing_step = 0.0;
    double max_range = 0.0;
  };
  std::vector<float> expected_;
  Expected expected_of_;
  int row_ = 0;
};

}  // namespace docent::collision_avoidance
