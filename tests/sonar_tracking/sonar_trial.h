#pragma once

#include <optional>
#include <ostream>

#include "docent/localization/sonar/tracker/sonar_tracker.h"
#include "office_drive.h"

namespace docent {

struct SonarTrialOptions {
  std::uint64_t seed = 1;  ///< of the building, its survey, the drive
  double minutes = 30.0;
  double max_speed = 0.9;  ///< [m/s]
  localization::SonarTrackerParams tracker;
};

struct SonarTrialResult {
  OfficeDrive drive;                                          ///< without events and truth
  double mean_error = 0.0, p95_error = 0.0, max_error = 0.0;  ///< [m], five times a second
  double mean_turn = 0.0, p95_turn = 0.0;                     ///< [rad] of heading
  double within_three = 0.0;  ///< share of position errors within three deviations of the tracker's own covariance
  localization::SonarTracker::Tally tally;
  double floor_area = 0.0;  ///< [m2] of the building
};

/// Draws the building, surveys it, drives, tracks from the true start with the survey's map, compares. The tracker sees
/// odometry and pings alone. @param trace  one line a sample, for pictures
[[nodiscard]] SonarTrialResult run_trial(const SonarTrialOptions& options, std::ostream* trace = nullptr);

}  // namespace docent
