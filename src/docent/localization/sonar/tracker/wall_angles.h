#pragma once

#include <optional>
#include <vector>

#include "docent/base/result.h"
#include "docent/geometry/pose2.h"

namespace docent::localization {

/// The directions of walls from echoes.
struct WallAngleParams {
  double length = 1.0;      ///< [m], > 0.2: way that a run of echoes must span
  int echoes = 5;           ///< >= 3, of a run
  double residual = 0.025;  ///< [m], > 0: root mean square distance from the line, at most
  double turn = 10.0;       ///< [deg], > 0: that the robot may turn during a run
  double jump = 0.12;       ///< [m], > 0: between neighbouring echoes, beyond what the way explains
  double range = 3.0;       ///< [m], > 0: longest echo used
  double oblique = 20.0;    ///< [deg], > 0: between the sonar's axis and the wall's normal, at most
  template <class V>
  void visit(V& v) {
    v("length", length);
    v("echoes", echoes);
    v("residual", residual);
    v("turn", turn);
    v("jump", jump);
    v("range", range);
    v("oblique", oblique);
  }
  [[nodiscard]] Result<void> validate() const;
};

struct WallAngle {
  Angle normal;            ///< direction towards the wall, frame of the track
  double deviation = 0.0;  ///< [rad]
};

/// Finds walls in the consecutive echoes of single sonars while the robot drives along them ([Buhmann1995],
/// "global navigation"). A smooth wall answers from the foot of the perpendicular wherever it lies in the cone, so an
/// echo says "the wall touches this circle": the line is fitted to circles, not to points on the axis.
class WallAngles {
 public:
  WallAngles(const WallAngleParams& params, int sonars);

  /// One echo; max range or nothing ends the run. @param track_from_sonar  in any frame that odometry keeps smooth
  /// @returns a wall when a run is complete; the next run begins with nothing, so no echo counts twice. O(echoes).
  std::optional<WallAngle> add(int sonar, const Pose2& track_from_sonar, std::optional<double> range);
  void forget();

 private:
  struct Echo {
    Pose2 track_from_sonar;
    double range;
  };
  [[nodiscard]] bool continues(const std::vector<Echo>& run, const Echo& echo) const;
  [[nodiscard]] std::optional<WallAngle> fit(const std::vector<Echo>& run) const;

  WallAngleParams params_;
  std::vector<std::vector<Echo>> runs_;  ///< one a sonar
};

}  // namespace docent::localization
