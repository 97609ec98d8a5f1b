#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/people/people_tracker.h"

namespace docent::people {

/// People who stand together.
struct GroupParams {
  double distance = 1.3;  ///< [m], > 0: people who belong together keep so near
  double speed = 0.4;     ///< [m/s], > 0: and go as fast, in the same direction
  double seconds = 2.0;   ///< [s], > 0: for so long
  template <class V>
  void visit(V& v) {
    v("distance", distance);
    v("speed", speed);
    v("seconds", seconds);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// People who stand or walk together.
class Groups {
 public:
  explicit Groups(const GroupParams& params) : params_{params} {}
  /// The group of each person: the lowest id among its members, 0 for who is alone. O(people^2).
  [[nodiscard]] std::vector<std::uint32_t> update(std::span<const TrackedPerson> people, Time now);

 private:
  GroupParams params_;
  struct Pair {
    std::pair<std::uint32_t, std::uint32_t> ids;  ///< rising
    double seconds = 0.0;                         ///< [s] together; falls when they part
  };
  std::vector<Pair> together_;  ///< by ids
  Time time_{};
};

}  // namespace docent::people
