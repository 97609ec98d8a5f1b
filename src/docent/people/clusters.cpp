#include "docent/people/clusters.h"

#include <algorithm>
#include <cmath>

namespace docent {

namespace {

/// Label of each point; labels count from 0 in the order of their first point.
std::vector<int> labels_of(std::span<const Point2> points, double gap, int& count) {
  std::vector<int> labels(points.size(), -1);
  std::vector<std::size_t> open;
  count = 0;
  for (std::size_t seed = 0; seed < points.size(); ++seed) {
    if (labels[seed] >= 0) continue;
    labels[seed] = count;
    open.assign(1, seed);
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (std::size_t other = seed + 1; other < points.size(); ++other) {
        if (labels[other] >= 0 || distance(points[at], points[other]) > gap) continue;
        labels[other] = count;
        open.push_back(other);
      }
    }
    ++count;
  }
  return labels;
}

Point2 mean_of(std::span<const Point2> points) {
  Point2 sum;
  for (const Point2 point : points) sum = sum + point;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

/// Direction of the greatest extent.
Point2 main_axis(std::span<const Point2> points, Point2 mean) {
  double xx = 0.0;
  double yy = 0.0;
  double xy = 0.0;
  for (const Point2 point : points) {
    const Point2 off = point - mean;
    xx += off.x * off.x;
    yy += off.y * off.y;
    xy += off.x * off.y;
  }
  return unit(Angle::radians(0.5 * std::atan2(2.0 * xy, xx - yy)));
}

}  // namespace

Result<void> ClusterParams::validate() const {
  if (!(gap > 0.0)) return fail("clusters.gap must be > 0");
  if (!(least_points >= 1)) return fail("clusters.least_points must be >= 1");
  if (!(person_width > 0.0)) return fail("clusters.person_width must be > 0");
  if (!(half_depth >= 0.0)) return fail("clusters.half_depth must be >= 0");
  return {};
}

std::vector<PersonSighting> find_people(std::span<const Point2> points, Point2 sensor, const ClusterParams& params) {
  int clusters = 0;
  const std::vector<int> labels = labels_of(points, params.gap, clusters);
  std::vector<std::vector<Point2>> members(static_cast<std::size_t>(clusters));
  for (std::size_t i = 0; i < points.size(); ++i) members[static_cast<std::size_t>(labels[i])].push_back(points[i]);

  std::vector<PersonSighting> people;
  for (auto& cluster : members) {
    if (static_cast<int>(cluster.size()) < params.least_points) continue;
    const Point2 axis = main_axis(cluster, mean_of(cluster));
    std::stable_sort(cluster.begin(), cluster.end(),
                     [axis](Point2 a, Point2 b) { return dot(a, axis) < dot(b, axis); });
    const double low = dot(cluster.front(), axis);
    const double width = dot(cluster.back(), axis) - low;
    const auto parts = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(width / params.person_width)));
    std::vector<std::vector<Point2>> pieces(parts);
    for (const Point2 point : cluster) {
      const double along = width > 0.0 ? (dot(point, axis) - low) / width : 0.0;
      pieces[std::min(parts - 1, static_cast<std::size_t>(along * static_cast<double>(parts)))].push_back(point);
    }
    for (const auto& piece : pieces) {
      if (piece.empty()) continue;
      const Point2 seen = mean_of(piece);
      people.push_back({seen + params.half_depth * unit(direction(sensor, seen)), static_cast<int>(piece.size())});
    }
  }
  return people;
}

}  // namespace docent
