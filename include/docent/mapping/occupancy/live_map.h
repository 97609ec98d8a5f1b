#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/polygon.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/mapping/occupancy/cell_rectangle.h"
#include "docent/mapping/occupancy/cone_layer.h"
#include "docent/mapping/occupancy/sight_layer.h"
#include "docent/mapping/occupancy/touch_layer.h"

namespace docent::mapping {

/// Section `map`: what stands in the hall now and not on the map.
struct LiveMapParams {
  int coarsening = 3;                      ///< live cell = so many cells of the static map
  double reach = 6.0;                      ///< [m], farther endpoints are not believed
  double static_margin = 0.25;             ///< [m]: nearer to a mapped obstacle an endpoint is that obstacle
  int hits_to_block = 3;                   ///< of the last four looks at a cell, 1..4
  double forget = 30.0;                    ///< [s] until a cell that nobody looked at is free again
  double settle = 20.0;                    ///< [s] that a cell was seen blocked, then what stands there is no passer-by
  double forget_settled = 300;             ///< [s] until such a cell that nobody looked at is free again
  double period = 0.5;                     ///< [s] between looks
  ConeLayerParams sonar{};                 ///< the sonars' layer
  ConeLayerParams infrared{.reach = 0.7};  ///< the infrared sensors' layer
  TouchLayerParams touch{};                ///< the layer of what was touched
  SightLayerParams sight{};                ///< and that of what cameras see
  template <class V>
  void visit(V& v) {
    v("coarsening", coarsening);
    v("reach", reach);
    v("static_margin", static_margin);
    v("hits_to_block", hits_to_block);
    v("forget", forget);
    v("settle", settle);
    v("forget_settled", forget_settled);
    v("period", period);
    v("sonar", sonar);
    v("infrared", infrared);
    v("touch", touch);
    v("sight", sight);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What stands in the hall now and not in the static map: layers over it with decay, one a kind of sensor, joined by
/// the max rule [Rhino1999] eq. (19), for each kind meets things at a height of its own: what one looks over the other
/// does not free.
///
/// The lasers' layer: a person who walks by leaves no trace; who stands for three looks of four, does. What was
/// seen to stand for longer, a stool or a closed passage, is settled: it is remembered for minutes while nobody looks,
/// and freed like all else by looks that pass through it. What sonars, infrared sensors or touch find and no laser sees
/// is furniture, and settled at once.
class LiveMap {
 public:
  /// @param hazards  [m], map: what sonars or touch meet near them is no news
  LiveMap(const OccupancyGrid& static_map, const LiveMapParams& params, std::span<const Polygon> hazards = {});

  /// One look: rays from `sensor` to `endpoints` (map frame). An endpoint beyond the reach only clears. O(rays * cells
  /// on them).
  /// @param looked  [m] so far the sensor looks: a ray of that length met nothing, and only clears
  void look(Point2 sensor, std::span<const Point2> endpoints, Time now,
            double looked = std::numeric_limits<double>::infinity());
  /// A sonar's reading, and an infrared sensor's. What a laser of these meets is in its own layer already. Where a
  /// sonar looks through what it had met itself, the thing is gone, and with it what the infrared sensors, which see no
  /// farther than an arm's length, had met there.
  void add_sonar(const ConeReading& reading, std::span<const LaserLook> lasers, Time now);
  /// An infrared sensor's reading, see add_sonar.
  void add_infrared(const ConeReading& reading, std::span<const LaserLook> lasers, Time now) {
    infrared_.add(reading, lasers, now);
  }
  /// The body was touched, see TouchLayer::feel; by what a laser of these sees, it is no news.
  void add_touch(Point2 at, Point2 outward, std::span<const LaserLook> lasers, Time now);
  /// Lines that nothing may touch, [m], map: see SightLayer. Each source has a layer of its own; of more than eight the
  /// later ones are not heard.
  void add_lines(const std::string& source, Point2 robot, std::span<const Segment> lines,
                 std::span<const LaserLook> lasers, Time now);
  /// See TouchLayer::stand.
  void stand(Point2 centre, double radius) { touch_.stand(centre, radius); }
  /// Frees what nobody looked at for too long. O(cells).
  void forget(Time now);

  [[nodiscard]] const GridFrame& frame() const { return static_.frame; }  ///< of the live cells
  static constexpr std::int8_t kPassing = 80;                             ///< blocked, as a person may block it
  static constexpr std::int8_t kSettled = OccupancyGrid::kOccupied;       ///< blocked by a thing
  /// The max rule: the largest of the static cell and those of all layers.
  [[nodiscard]] std::int8_t cell(std::size_t index) const;
  /// By what any layer shows.
  [[nodiscard]] bool is_blocked(std::size_t index) const { return live_cell(index) > 0; }
  /// The cells that changed since the last call; nullopt when none did.
  [[nodiscard]] std::optional<CellRectangle> take_changes();

 private:
  [[nodiscard]] bool is_seen(std::size_t index) const;
  [[nodiscard]] bool is_settled(std::size_t index) const { return is_seen(index) && settled_[index]; }
  [[nodiscard]] std::int8_t live_cell(std::size_t index) const;
  void mark(CellIndex cell, bool hit, Time now);

  LiveMapParams params_;
  OccupancyGrid static_;               ///< coarsened
  std::vector<bool> near_static_;      ///< an endpoint here belongs to the static map
  std::vector<std::uint8_t> history_;  ///< the last eight looks, the newest in bit 0
  std::vector<Time> seen_;
  std::vector<Time> blocked_since_;
  std::vector<bool> settled_;
  std::vector<std::uint32_t> look_of_;  ///< the last look that touched the cell: one entry in the history a look
  std::uint32_t look_ = 0;
  std::optional<CellRectangle> changes_;
  std::vector<bool> known_;  ///< an echo or a touch here belongs to the static map or to a hazard
  ConeLayer sonar_;
  ConeLayer infrared_;
  TouchLayer touch_;
  std::map<std::string, SightLayer> sights_;  ///< by source
};

}  // namespace docent::mapping
