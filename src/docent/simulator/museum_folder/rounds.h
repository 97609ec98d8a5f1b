#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace docent::simulator {

/// How many stops a visitor follows a robot to: RHINO's and Minerva's tours had four to six.
constexpr std::size_t kMostStopsOfARound = 5;
/// How far [m] all of them follow it on average, from home and back: five minutes among people.
constexpr double kLongestRound = 140.0;

/// The stops of a floor as rounds that a visitor follows: one short way through all of them from home and back (nearest
/// neighbour, then 2-opt), cut into pieces of nearly the same number of stops, at most kMostStopsOfARound, and into
/// more of at least two stops where the way is longer than kLongestRound times their number.
/// @param ways  [1 + stops][1 + stops] lengths [m], symmetric; the first row and column are of home
/// @returns numbers of stops from 0; every stop is in one round. O(stops^3).
[[nodiscard]] std::vector<std::vector<std::size_t>> rounds_of(std::span<const std::vector<double>> ways);

}  // namespace docent::simulator
