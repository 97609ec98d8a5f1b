#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/base/time.h"
#include "docent/geometry/pose2.h"

namespace docent::vision {

struct ThingMapParams {
  double gate = 9.21;     ///< > 0 squared Mahalanobis distance: chi² of two degrees at 99 %
  double apart = 0.12;    ///< [m] >= 0: what is nearer than that is the same thing whatever the covariances say
  double drift = 0.0004;  ///< [m²] >= 0 that looks do not average away: the map and the robot's place are off together
  int least_known = 3;    ///< >= 1 looks in which it was known as what it is called
  double least_share = 0.6;  ///< 0.5..1 of the looks at which it was named at all
  int gone_after = 4;        ///< >= 1 looks at bare floor in its place, one after the other
  int most = 500;            ///< >= 1 things; the one seen longest ago is forgotten
  template <class V>
  void visit(V& v) {
    v("gate", gate);
    v("apart", apart);
    v("drift", drift);
    v("least_known", least_known);
    v("least_share", least_share);
    v("gone_after", gone_after);
    v("most", most);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// A thing in one picture, on the map.
struct ThingLook {
  Point2 in_map;               ///< [m]
  Eigen::Matrix2d covariance;  ///< [m²] the robot's own included
  double width = 0.0;          ///< [m]
  double height = 0.0;         ///< [m]
  bool is_named = false;       ///< its colours were seen, too
  std::string object;          ///< what it is; empty: none of the classes
};

/// A thing as several looks together have it.
struct MappedThing {
  std::uint32_t id = 0;
  Point2 in_map;               ///< [m]
  Eigen::Matrix2d covariance;  ///< [m²]
  double width = 0.0;          ///< [m] mean
  double height = 0.0;         ///< [m] mean
  int looks = 0;
  int named = 0;                     ///< looks at which its colours were seen
  std::map<std::string, int> votes;  ///< looks in which it was known as that; not those as none of the classes
  int bare = 0;                      ///< looks at bare floor in its place, the last ones
  Time last;                         ///< when it was seen
};

/// Things on the map, put together of looks from several places: each look belongs to the nearest thing within its
/// gate, or is a new one. Not removed by silence, but by bare floor that is seen where it lay. Deterministic.
class ThingMap {
 public:
  explicit ThingMap(const ThingMapParams& params = {}) : params_{params} {}

  /// O(things)
  void add(const ThingLook& look, Time now);
  /// Bare floor was seen in its place, in a picture that shows nothing there.
  void see_bare(std::uint32_t id);
  [[nodiscard]] const std::vector<MappedThing>& things() const { return things_; }
  /// What it is, when it is sure; empty: not.
  [[nodiscard]] std::string object_of(const MappedThing& thing) const;

 private:
  ThingMapParams params_;
  std::vector<MappedThing> things_;
  std::uint32_t next_ = 1;
};

}  // namespace docent::vision
