#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::mapping {

/// How evidence becomes cells.
struct ScanMapperParams {
  double resolution = 0.05;  ///< [m/cell], 0.01..1
  double hit = 0.7;          ///< P(occupied | a beam ends in the cell), 0.5..1
  double pass = 0.35;        ///< P(occupied | a beam goes through it), 0..0.5
  double most_log_odds = 4;  ///< [nat], > 0: so that a cell can change its mind
  double reach = 25.0;       ///< [m], > 0: beyond it an error of half a degree is many cells
  double margin = 0.10;      ///< [m], >= 0: so near the surface it ends on a beam says nothing; walls are rough
  double empty_reach = 0.0;  ///< [m], >= 0: so far a beam without a return shows free floor; 0: it says nothing
  double widest_gap = 2.0;   ///< [deg], >= 0: between beams no farther apart the floor is clear as far as both saw
  double widest_wall = 0.4;  ///< [m], >= 0: ends of such neighbours no farther apart lie on one surface
  double border = 1.0;       ///< [m], >= 0, about everything that was seen
  double occupied = 0.6;     ///< a cell of at least this probability is drawn occupied, and
  double free = 0.4;         ///< of at most this one free; the rest is unknown
  double most_free_pieces = 0.25;  ///< >= 0: for each piece that met a wall's cell, so many that saw through
  int fewest_hits = 1;  ///< > 0: sweeps that a cell was met in, else it is unknown: who walks by is met once or twice
  template <class V>
  void visit(V& v) {
    v("resolution", resolution);
    v("hit", hit);
    v("pass", pass);
    v("most_log_odds", most_log_odds);
    v("reach", reach);
    v("margin", margin);
    v("empty_reach", empty_reach);
    v("widest_gap", widest_gap);
    v("widest_wall", widest_wall);
    v("border", border);
    v("occupied", occupied);
    v("free", free);
    v("most_free_pieces", most_free_pieces);
    v("fewest_hits", fewest_hits);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// `ScanMapperParams::fewest_hits` for sweeps taken at these places, in their order: a wall is met by each sweep over
/// half a metre of way at least; who walks by is met once or twice. 1..3. O(n).
[[nodiscard]] int fewest_hits_of(std::span<const Pose2> map_from_base);

/// A sweep as seen from its sensor, and where the sensor was.
struct PlacedSweep {
  sensor_models::RangeSweep sweep;  ///< sensor frame
  Pose2 map_from_sensor;            ///< where the sensor was
};

/// Occupancy map of sweeps at known poses [Rhino1999] 3.2.1, Table 3: evidence of each sweep is added to each cell as
/// log odds (eq. 17, prior 0.5). The inverse sensor model is made by hand: the cell a beam ends in was hit, those
/// before it were passed. Departures: a cell counts once a sweep, however many beams meet it there (beams of one sweep
/// err together), and a hit wins; log odds are bounded. A beam without a return says nothing, unless
/// `empty_reach` says how far: glass and black cloth give none either.
class ScanMapper {
 public:
  /// The smallest frame that holds all sensors and endpoints within reach, and the border. Error: nothing to map, or
  /// more than 400 million cells. @pre params are valid
  [[nodiscard]] static Result<GridFrame> frame_of(std::span<const PlacedSweep> sweeps, const ScanMapperParams& params);

  /// All cells unknown. `frame`: of any resolution. @pre params are valid
  ScanMapper(const GridFrame& frame, const ScanMapperParams& params);

  /// O(cells in view). What lies outside the frame is passed over.
  void add(const PlacedSweep& placed);
  /// The body stood here: the floor within `radius` [m] was free. O(cells within).
  void stand(Point2 centre, double radius);
  /// The sweeps since the last call were one piece of the way, some metres or half a minute of it. Whoever stands
  /// before the robot for a while is met by many sweeps of one piece, and not by those of another time: each piece has
  /// one vote on what a cell is. Without a call evidence alone counts. O(cells seen since).
  void end_piece();
  [[nodiscard]] OccupancyGrid map() const;                                     ///< as drawn so far
  [[nodiscard]] std::span<const float> log_odds() const { return log_odds_; }  ///< [rows * columns]

 private:
  void add_evidence(CellIndex cell, float evidence);
  void mark_line(Point2 from, Point2 to, float evidence);
  void clear_triangle(Point2 a, Point2 b, Point2 c);
  /// Whether beam `n` is the neighbour of beam `i`.
  [[nodiscard]] bool are_neighbours(std::span<const sensor_models::SweepBeam> beams, std::size_t i,
                                    std::size_t n) const;
  /// Beam `n` where it is the neighbour of beam `i` and came back; else none.
  [[nodiscard]] const sensor_models::SweepBeam* neighbour_of(std::span<const sensor_models::SweepBeam> beams,
                                                             std::size_t i, std::size_t n) const;
  /// [m] up to where each beam passed free space for certain: `margin` from the surface it ended on, measured square
  /// to it. A beam that grazes a wall runs beside it for metres, nearer than poses are known.
  [[nodiscard]] std::vector<double> clear_ranges(std::span<const sensor_models::SweepBeam> beams) const;

  GridFrame frame_;
  ScanMapperParams params_;
  float hit_;                       ///< log odds
  float pass_;                      ///< log odds
  std::vector<float> log_odds_;     ///< [rows * columns]
  std::vector<std::uint8_t> hits_;  ///< [rows * columns] sweeps that met the cell, up to 255
  std::vector<std::uint32_t> met_;  ///< the last sweep that said something of the cell
  std::uint32_t sweep_ = 0;
  std::vector<float> piece_log_odds_;       ///< [rows * columns] of this piece alone
  std::vector<std::size_t> seen_in_piece_;  ///< cells
  std::vector<std::uint8_t> met_by_;        ///< [rows * columns] pieces that met something there, up to 255
  std::vector<std::uint8_t> freed_by_;      ///< [rows * columns] pieces that saw through, up to 255
};

}  // namespace docent::mapping
