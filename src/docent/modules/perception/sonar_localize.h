#pragma once

#include <optional>

#include "docent/localization/sonar/tracker/sonar_tracker.h"
#include "docent/modules/shared/module.h"

namespace docent::modules {

/// Section `localize.sonar` of robot.yaml: for robots without laser, `localize.method: sonar`.
struct SonarLocalizeParams {
  localization::SonarTrackerParams tracker;
  std::optional<double> start_x;        ///< [m], map; without: the museum's home
  std::optional<double> start_y;        ///< [m], map
  std::optional<double> start_heading;  ///< [deg] in the map; absent: unknown
  double start_position_error = 0.1;    ///< [m], > 0: standard deviation of the start
  double start_heading_error = 3.0;     ///< [deg], > 0
  template <class V>
  void visit(V& v) {
    tracker.visit(v);
    v("start_x", start_x);
    v("start_y", start_y);
    v("start_heading", start_heading);
    v("start_position_error", start_position_error);
    v("start_heading_error", start_heading_error);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// `localize` by sonars alone: the topics that `localize` publishes, from a sonar tracker. It starts where it is told,
/// or where its checkpoint says.
[[nodiscard]] std::unique_ptr<Module> make_sonar_localize(const ModuleContext& context,
                                                          const SonarLocalizeParams& params);

}  // namespace docent::modules
