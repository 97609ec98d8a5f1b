#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include "docent/base/time.h"
#include "docent/geometry/pose2.h"
#include "docent/planning/navigator/whereabouts.h"

namespace docent::planning {

/// Distances of one moment, measured or virtual.
struct Sweep {
  Time taken{};
  double first_bearing = 0.0;  ///< [rad], sensor frame
  double bearing_step = 0.0;   ///< [rad]
  double max_range = 0.0;      ///< [m]
  std::vector<float> ranges;   ///< [m]; empty: nothing was seen yet
};

/// How far it is free all round a lost robot: keeps the newest sweeps, and those of the last turn.
class Lookout {
 public:
  /// @param base_from_scanner  [scanners] where they are mounted
  explicit Lookout(std::vector<Pose2> base_from_scanner);

  void see(std::size_t scanner, Sweep sweep) { newest_[scanner] = std::move(sweep); }
  /// It is found to be mounted elsewhere.
  void mount(std::size_t scanner, const Pose2& base_from_scanner) { base_from_scanner_[scanner] = base_from_scanner; }
  /// Virtual measurements, base frame.
  void see_hazards(Sweep sweep) { hazards_ = std::move(sweep); }

  /// The smaller of real and virtual measurements in every direction from where the base is now; where no scanner reads
  /// now, what one saw there a moment ago. Empty when any is missing or old.
  /// @param where  with odometry
  /// @returns [Clearances::kDirections] [m], base frame
  [[nodiscard]] std::vector<double> clearances(const Whereabouts& where, Time now);
  /// Why nothing was free when that was last asked for, for an operator.
  [[nodiscard]] std::string hindrance() const;
  /// [m] that the scanners look.
  [[nodiscard]] double reach() const;

 private:
  struct PastLook {
    Time at;
    std::vector<Sweep> sweeps;  ///< [scanners]
  };
  void remember(Time now);

  std::vector<Pose2> base_from_scanner_;
  std::vector<Sweep> newest_;  ///< [scanners]
  Sweep hazards_;
  std::deque<PastLook> past_;  ///< the oldest first
  double widest_real_ = 0.0;   ///< [m] of the directions that were asked for last, by the scanners alone
};

}  // namespace docent::planning
