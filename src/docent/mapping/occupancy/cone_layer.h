#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/mapping/occupancy/cell_rectangle.h"

namespace docent::mapping {

/// Parts `sonar` and `infrared` of section `map` of robot.yaml.
struct ConeLayerParams {
  double reach = 1.5;         ///< [m] > 0: what answers from farther away is not believed
  double least_cone = 0.13;   ///< [rad] half a cone at least: the places and axes of a ring are known no better
  double hit = 0.7;           ///< log-odds > 0 that a cell on the echo's arc gains
  double pass = 0.5;          ///< log-odds > 0 that a cell before the echo loses
  double most = 3.0;          ///< log-odds: a cell gains no more, so that what is taken away is gone after a few looks
  double least = -0.8;        ///< log-odds < 0: it loses no more, so that what is put there is seen after a few
  double block = 1.8;         ///< log-odds: from here on a cell is blocked, until it is back at 0
  double explain = 0.25;      ///< [m] >= 0 beyond the echo, within which a laser's point is what answered
  double forget = 30.0;       ///< [s] until a cell that nobody looked at is free again
  double forget_thing = 300;  ///< [s] >= forget, likewise where no laser saw anybody
  template <class V>
  void visit(V& v) {
    v("reach", reach);
    v("least_cone", least_cone);
    v("hit", hit);
    v("pass", pass);
    v("most", most);
    v("least", least);
    v("block", block);
    v("explain", explain);
    v("forget", forget);
    v("forget_thing", forget_thing);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// One reading of a sensor that hears or sees a cone.
struct ConeReading {
  Pose2 map_from_sensor;
  double field_of_view = 0.0;  ///< [rad] the whole cone
  double max_range = 0.0;      ///< [m]; this or more: nothing answered
  double range = 0.0;          ///< [m]; NaN: no reading
};

/// The newest sweep of a laser.
struct LaserLook {
  Pose2 map_from_sensor;
  double first_bearing = 0.0;           ///< [rad], sensor frame
  double field = 0.0;                   ///< [rad] that it covers from there, counter-clockwise
  std::span<const Point2> endpoints{};  ///< [m], map
};

/// What the lasers know of that which answered in a cone.
enum class LaserWord {
  looks_over,    ///< a laser looks there and meets nothing: it is lower than the lasers, or of glass
  meets,         ///< a laser meets it: it stands in the laser layer already
  does_not_look  ///< no laser looks there: it may be anything, somebody too
};

/// What one kind of cone sensor, the sonars or the infrared sensors, finds below the lasers. A layer of its own, for it
/// looks at another height: within it readings are fused by Bayes' rule [Rhino1999] eq. (18), with other layers they
/// are joined by the max rule alone [Rhino1999] eq. (19). An echo may come from anywhere on its arc, and what lies
/// before the arc is free; so readings from several places leave of each arc what all of them allow.
class ConeLayer {
 public:
  /// @param known  [rows * columns] cells where an echo is no news: near a mapped wall or hazard
  ConeLayer(const GridFrame& frame, std::vector<bool> known, const ConeLayerParams& params);

  /// O(cells in the cone), and O(endpoints) where something answered within reach.
  void add(const ConeReading& reading, std::span<const LaserLook> lasers, Time now);
  /// Frees what nobody looked at for too long. O(cells).
  void forget(Time now);
  /// Cells that were blocked until a reading went through them, since the last call.
  [[nodiscard]] std::vector<CellIndex> take_gone() { return std::exchange(gone_, {}); }
  /// Another sensor, which had met the same thing, has seen that it is gone: the cell is as if never looked at.
  void release(CellIndex cell);

  [[nodiscard]] bool is_blocked(std::size_t index) const { return blocked_[index]; }
  /// A blocked cell where a laser looked and saw nobody: a thing, that stays.
  [[nodiscard]] bool is_thing(std::size_t index) const { return blocked_[index] && thing_[index]; }
  /// Cells that became blocked, free, or a thing since the last call.
  [[nodiscard]] std::optional<CellRectangle> take_changes();

 private:
  [[nodiscard]] double half_cone(const ConeReading& reading) const;
  [[nodiscard]] std::vector<CellIndex> arc(const ConeReading& reading, double half) const;
  [[nodiscard]] LaserWord ask(const ConeReading& reading, std::span<const LaserLook> lasers) const;
  void clear(const ConeReading& reading, Time now);
  void change(CellIndex cell, double evidence, bool is_thing, Time now);

  GridFrame frame_;
  ConeLayerParams params_;
  std::vector<bool> known_;
  std::vector<float> evidence_;  ///< [rows * columns] log-odds of occupied over free
  std::vector<bool> blocked_;
  std::vector<bool> thing_;
  std::vector<Time> seen_;
  std::vector<CellIndex> gone_;
  std::optional<CellRectangle> changes_;
};

}  // namespace docent::mapping
