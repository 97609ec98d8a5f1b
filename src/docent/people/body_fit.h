#pragma once

#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::people {

/// A disc as wide as a person, seen from one side.
struct Body {
  Point2 centre;        ///< [m], frame of the points
  double radius = 0.0;  ///< [m]
  int points = 0;
};

/// The fewest discs of people's width that explain a run of points on their near sides.
struct BodyFit {
  std::vector<Body> bodies;
  double cost = 0.0;    ///< [nat], with the price of every body
  double misfit = 0.0;  ///< [nat] of all points, without it
  /// [nat] by which one straight face, a corner, or one disc wider than any person explains the points better; very
  /// negative where the points are too few or too close to tell.
  double thing_gain = -10.0;
};

/// Fits one disc, two, … to the points. Centres move to where the points, pushed inward by a radius along their
/// normals, meet (the geometric circle fit of a known radius), points go to the disc whose rim is nearest, and a disc
/// must be worth its price. A child, an adult and a broad adult are tried as radii.
/// @param points  [m], in the order of their bearings; not empty
/// @param sensor  where they were seen from, same frame
/// @param known   where bodies are expected; a disc near one of them costs less, and fits begin there, too
/// O(points * bodies * iterations).
[[nodiscard]] BodyFit fit_bodies(std::span<const Point2> points, Point2 sensor, std::span<const Point2> known);

}  // namespace docent::people
