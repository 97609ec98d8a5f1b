#pragma once

#include <map>
#include <set>
#include <string>

#include "docent/base/yaml.h"
#include "docent/geometry/pose2.h"

namespace docent::simulator {

/// In what a robot differs from what its robot.yaml, and whoever set it down, say: of the true world alone.
struct BuildErrors {
  std::map<std::string, Pose2> mounts;  ///< by the scanner's name: nominal_from_true, turned about the scanner itself
  std::map<std::string, double> late;   ///< [s] likewise: sent so long after the sweep, with the stamp of then
  std::set<std::string> mirrored;       ///< likewise: it hangs where it is said to stand, or stands
  double way = 1.0;                     ///< metres that odometry counts for each true one
  double rate = 20.0;                   ///< [Hz] 1..100 of odometry, as near as steps of 10 ms are
  double turn = 1.0;                    ///< likewise of turns
  Pose2 start;                          ///< said_from_true: it stands so far from where it is told
};

/// Reads `{mounts: {NAME: {x, y, heading}}, late: {NAME: SECONDS}, mirrored: [NAME], odometry: {way, turn, rate},
/// start: {x, y, heading}}`, each of which may be left out; x and y of mounts in the robot's frame. Throws YamlFault.
[[nodiscard]] BuildErrors read_build_errors(const YamlFile& file, const YAML::Node& node);

/// What odometry with wrong scales makes of the true one, reading by reading.
class OdometryScale {
 public:
  OdometryScale(double way, double turn) : way_{way}, turn_{turn} {}
  [[nodiscard]] Pose2 apply(const Pose2& odom_from_base);

 private:
  double way_;
  double turn_;
  bool has_last_ = false;
  Pose2 last_;
  Pose2 scaled_;
};

}  // namespace docent::simulator
