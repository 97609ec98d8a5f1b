#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/mapping/graph_mapping/mapping_scan.h"
#include "docent/mapping/occupancy/scan_mapper.h"
#include "docent/mapping/scan_matching/match_grid.h"

namespace docent::mapping {

/// Pieces of the way that are matched to each other.
struct SubmapParams {
  double way = 3.0;          ///< [m], > 0: a submap ends after this way,
  double turn = 6.0;         ///< [rad], > 0: this much turning,
  int scans = 40;            ///< > 0: or so many scans
  double reach = 12.0;       ///< [m], > 0, from its middle: what lies farther depends on the chain's heading too much
  double query_cell = 0.20;  ///< [m], > 0: one point a cell takes part in a search
  double still = 0.3;        ///< 0..1: a point whose cell was ended in by less of the scans that saw it moved on
  double free_cell = 0.10;   ///< [m], > 0: of what was seen through
  template <class V>
  void visit(V& v) {
    v("way", way);
    v("turn", turn);
    v("scans", scans);
    v("reach", reach);
    v("query_cell", query_cell);
    v("still", still);
    v("free_cell", free_cell);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A short piece of the way, over which the chain of scans is trusted: one small map about its middle scan. Points that
/// later or earlier scans of the same piece saw through were of somebody who walked, and are left out.
class Submap {
 public:
  /// Scans `first` to `last` of all, at these poses of the chain. @pre first <= last
  Submap(std::span<const MappingScan> scans, std::span<const Pose2> map_from_base, std::size_t first, std::size_t last,
         const SubmapParams& params, const MatchGridParams& grid);

  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] std::size_t last() const { return last_; }
  [[nodiscard]] std::size_t middle() const { return (first_ + last_) / 2; }  ///< the scan whose frame all is seen in
  [[nodiscard]] std::span<const SurfacePoint> points() const { return points_; }
  [[nodiscard]] std::span<const Point2> query() const { return query_; }  ///< thinned
  [[nodiscard]] const MatchGrid& grid() const { return *grid_; }
  /// Beams went through here, clear of everything.
  [[nodiscard]] bool is_free(Point2 at) const;

 private:
  struct Seen;  ///< how often each cell was ended in and passed through
  [[nodiscard]] Seen look(std::span<const MappingScan> scans, std::span<const Pose2> map_from_base,
                          const SubmapParams& params) const;

  std::size_t first_;
  std::size_t last_;
  std::vector<SurfacePoint> points_;  ///< [m], middle scan's base frame
  std::vector<Point2> query_;
  std::unique_ptr<MatchGrid> grid_;
  GridFrame free_frame_;
  std::vector<bool> free_;
};

/// Share of the points of one submap that lie on floor which the other one saw free; of both ways the larger one.
[[nodiscard]] double share_in_conflict(const Submap& older, const Submap& newer, const Pose2& older_from_newer);

}  // namespace docent::mapping
