#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/planning/detour/detour.h"

namespace docent::planning {

/// When a blocked way is left for another one.
struct DetourParams {
  double corridor = 0.7;     ///< [m] > 0: a way that stays so near to the meant one is the same
  double back_within = 6.0;  ///< [m] > 0 of way: a local detour is back on the meant one by then
  double local_extra = 3.0;  ///< [m] >= 0 that a local detour is longer at most
  double lasts = 0.8;        ///< [s] >= 0 that another way must stand until it counts
  template <class V>
  void visit(V& v) {
    v("corridor", corridor);
    v("back_within", back_within);
    v("local_extra", local_extra);
    v("lasts", lasts);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A line of points and the length [m] from its first point to each.
struct MeasuredWay {
  std::vector<Point2> points;
  std::vector<double> along;  ///< [m]
  explicit MeasuredWay(std::span<const Point2> way = {});
  [[nodiscard]] double length() const { return along.empty() ? 0.0 : along.back(); }
};

/// Compares the way that steepest descent of the value function gives now with the one that was meant before something
/// stood in it ([Rhino1999] 5.3): a detour that comes back to the meant way soon is local, one along another way is
/// global. Progress is judged in metres along both. A detour counts when it has lasted, for people in the way let two
/// ways take turns. After a global detour the new way is the one that is meant.
class DetourWatch {
 public:
  explicit DetourWatch(const DetourParams& params) : params_{params} {}

  /// Another goal: the next way is the one that is meant.
  void restart() { *this = DetourWatch{params_}; }
  /// @param way  from the robot to the goal, map frame. O(points of both ways) where they agree, else O(product).
  Detour update(std::span<const Point2> way, Time now);
  [[nodiscard]] Detour change() const { return change_; }
  /// [m] that the present detour is longer than the meant way.
  [[nodiscard]] double extra() const { return extra_; }

 private:
  struct Judgement {
    Detour change = Detour::none;
    double extra = 0.0;
  };
  [[nodiscard]] Judgement judge(const MeasuredWay& way) const;

  DetourParams params_;
  MeasuredWay meant_;
  Detour seen_ = Detour::none;  ///< as it looks now
  Time seen_since_{};
  Detour change_ = Detour::none;
  double extra_ = 0.0;
};

}  // namespace docent::planning
