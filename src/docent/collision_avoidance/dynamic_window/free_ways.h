#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "docent/collision_avoidance/body/arc_distance.h"
#include "docent/collision_avoidance/dynamic_window/velocity_kernel.h"

namespace docent::collision_avoidance {

/// The free way along any number of circular arcs against a set of points, exactly, and some hundred times faster than
/// `arc_distance` for every pair: `build` once a cycle, then ask.
///
/// An arc of curvature k comes within `reach` of a point at (x, y), d away, only if |k (d^2 - reach^2) / 2 - y| <
/// reach: an interval of curvatures, narrow for what is far. The fan of all curvatures is cut into lanes, and each lane
/// lists the points that an arc in it can meet, nearest first. Which contact comes first is told by the squared chord,
/// so that the one inverse sine is taken of the nearest alone.
class FreeWays {
 public:
  static constexpr double kHorizon = 4.0;       ///< [m] ways beyond count as so much
  static constexpr double kMaxCurvature = 6.0;  ///< [1/m]; a tighter curve is nearly a turn on the spot

  explicit FreeWays(InstructionSet set = instruction_sets().back());

  /// `backwards`: for arcs that are driven in reverse. O(points * lanes that they block).
  void build(std::span<const ReachPoint> points, bool backwards);
  /// As the least arc_distance over all points, at most kHorizon, for each of the curvatures [1/m] (linear and angular
  /// velocity's quotient, also in reverse), which are clamped to kMaxCurvature.
  void along(std::span<const double> curvatures, std::span<double> ways);

 private:
  static constexpr int kLanes = 96;
  [[nodiscard]] static int lane_of(double curvature);
  void sort();
  void fill_lanes();

  const VelocityKernels& kernels_;
  bool stands_ = false;  ///< a point within reach lies ahead
  std::vector<Contact> contacts_;
  std::vector<Contact> unsorted_;
  std::vector<std::array<std::uint8_t, 2>> blocked_;  ///< first and last lane of each contact
  std::array<std::uint32_t, kLanes + 1> starts_{};    ///< of each lane in lists_
  std::vector<std::uint32_t> lists_;                  ///< contacts, grouped by lane
  std::vector<std::uint32_t> asked_;                  ///< arcs, grouped by lane
  std::vector<std::uint8_t> lanes_;                   ///< of each arc
};

}  // namespace docent::collision_avoidance
