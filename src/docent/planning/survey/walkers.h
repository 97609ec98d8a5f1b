#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::planning {

/// Somebody, or something that looks like somebody, who is tracked.
struct TrackedPerson {
  std::uint32_t id = 0;  ///< the same as long as it is tracked
  Point2 place;          ///< [m], odom
};

/// Those of the tracked who have walked: things that stand are tracked, too, where they look like somebody.
class Walkers {
 public:
  /// All who are tracked at present; who is not among them is forgotten.
  void note(std::span<const TrackedPerson> people);
  [[nodiscard]] std::span<const Point2> places() const { return places_; }  ///< [m], odom, at present

 private:
  struct Track {
    Point2 first;
    bool has_walked = false;
  };
  std::map<std::uint32_t, Track> tracks_;
  std::vector<Point2> places_;
};

}  // namespace docent::planning
