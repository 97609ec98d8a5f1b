#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::simulator {

/// How many stops a visitor follows a robot to: RHINO's and Minerva's tours had four to six.
constexpr std::size_t kMostStopsOfARound = 5;

/// The places of a floor as rounds that a visitor follows: one short way through all of them from `home` and back
/// (nearest neighbour, then 2-opt, by straight distances), cut into pieces of nearly the same number of places, at most
/// kMostStopsOfARound. Indices of `places`; every place is in one round. O(places^3).
[[nodiscard]] std::vector<std::vector<std::size_t>> rounds_of(Point2 home, std::span<const Point2> places);

}  // namespace docent::simulator
