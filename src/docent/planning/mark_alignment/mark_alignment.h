#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/polygon.h"
#include "docent/geometry/pose2.h"
#include "docent/mapping/scan_matching/point_sweep.h"

namespace docent::planning {

/// Part `alignment` of section `explore`: how what people have marked is laid onto what is seen.
struct MarkAlignmentParams {
  double start_position = 0.2;  ///< [m], >= 0: how far off the place may be that the robot was told, and
  double start_heading = 4.0;   ///< [deg], >= 0: the heading; standard deviations: it may be off by 2.5 of them
  double sigmas = 2.5;          ///< >= 0: of where marks lie, that the robot keeps off beside all other margins
  double free = 0.15;           ///< [m], >= 0: of them that other margins hold already
  double wall_reach = 1.6;      ///< [m], > 0: walls stand at most so far outside the border of the area
  double wall_sigma = 0.08;     ///< [m], > 0: how evenly the border was drawn along the walls
  double least_wall = 8.0;      ///< [m], > 0: less of walls along the border says nothing
  double distinct = 1.15;       ///< > 1: by so much the best place must fit better than any other one
  template <class V>
  void visit(V& v) {
    v("start_position", start_position);
    v("start_heading", start_heading);
    v("sigmas", sigmas);
    v("free", free);
    v("wall_reach", wall_reach);
    v("wall_sigma", wall_sigma);
    v("least_wall", least_wall);
    v("distinct", distinct);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// Where the marks of a site, its area and hazards, lie in the map that a robot makes of it. The robot was told where
/// it begins, and was set down by hand: marks far away are off by as much as its heading was. The border of an area is
/// drawn along walls, at some distance that is the same everywhere: so far outside it walls are looked for, and the
/// place at which most are met is where the marks lie. Deterministic.
class MarkAlignment {
 public:
  /// @param area  [m], site; empty: nothing can be aligned
  /// @param start  where the robot was told to begin, site and survey
  MarkAlignment(const MarkAlignmentParams& params, const Polygon& area, const Pose2& start);

  /// @param walls  [m] of what is seen, in the survey's frame, with normals towards the robot; one of some decimetres
  /// @returns whether the marks lie elsewhere now. O(headings * (walls * sides + places))
  bool align(std::span<const mapping::SurfacePoint> walls);

  [[nodiscard]] const Pose2& site_from_survey() const { return site_from_survey_; }
  [[nodiscard]] bool is_aligned() const { return is_aligned_; }
  /// [m] that marks near a place may lie off, all but surely; beyond what other margins hold.
  [[nodiscard]] double margin_at(Point2 site) const;

 private:
  struct Border {
    Segment side;
    Point2 outward;       ///< of length 1
    double offset = 0.0;  ///< dot(outward, side)
    double length = 0.0;  ///< [m]
  };
  struct Place {
    double x = 0.0, y = 0.0, heading = 0.0;  ///< [m], [rad]: about the start
    double gap = 0.0;                        ///< [m] of the walls outside the border
    double score = 0.0;                      ///< [m] of walls that are met
  };
  /// What of the walls may stand along each side of the border, at one heading.
  struct Histograms {
    std::vector<std::vector<float>> walls;  ///< [sides][bins] [m] of wall by the distance outside the border
  };
  [[nodiscard]] Histograms histograms(std::span<const mapping::SurfacePoint> walls, double heading, Point2 shift) const;
  void smooth(Histograms& histograms) const;
  [[nodiscard]] double unlikely(double x, double y, double heading) const;
  [[nodiscard]] double score(const Histograms& histograms, Point2 shift, double gap) const;
  void search(std::span<const mapping::SurfacePoint> walls, std::vector<Place>& places) const;
  [[nodiscard]] Place refined(std::span<const mapping::SurfacePoint> walls, Place place) const;
  /// Inverse covariance of (x, y, heading, gap) at a place.
  [[nodiscard]] Eigen::Matrix4d information(std::span<const mapping::SurfacePoint> walls, const Place& place) const;
  [[nodiscard]] Pose2 pose_of(const Place& place) const;

  MarkAlignmentParams params_;
  Pose2 start_;
  std::vector<Border> borders_;
  Pose2 site_from_survey_;
  Eigen::Matrix3d covariance_;  ///< of (x, y, heading) about the start
  bool is_aligned_ = false;
};

}  // namespace docent::planning
