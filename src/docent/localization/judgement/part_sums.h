#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::localization {

/// What one reading says against a pose, and of which part of the building it says so.
struct PartCost {
  std::uint64_t part = 0;
  float cost = 0.0F;  ///< 0..1
};

/// The part of the building that holds a point: a square, and what readings can be wrong about there.
[[nodiscard]] std::uint64_t part_at(Point2 in_map, double side, bool is_wall);
[[nodiscard]] bool is_wall(std::uint64_t part);

/// What readings say against a way, by parts of the building: what the map has wrong at one part shows in every scan
/// that sees it, and is one piece of evidence, not many.
class PartSums {
 public:
  /// `prior_beams`: readings without fault that every part is given: few readings tell little.
  explicit PartSums(double prior_beams) : prior_beams_{prior_beams} {}
  void add(std::span<const PartCost> costs);
  void take_out(std::span<const PartCost> costs);  ///< that were added
  /// Sum over the walls' parts of the mean cost of their readings.
  [[nodiscard]] double walls() const { return walls_; }
  /// Likewise, over the floor's parts, where readings ended too early.
  [[nodiscard]] double floor() const { return floor_; }

 private:
  struct Sum {
    double cost = 0.0;
    int count = 0;
  };
  void change(const PartCost& by, int count);

  double prior_beams_;
  double walls_ = 0.0, floor_ = 0.0;  ///< sums of the parts' costs
  std::unordered_map<std::uint64_t, Sum> parts_;
};

}  // namespace docent::localization
