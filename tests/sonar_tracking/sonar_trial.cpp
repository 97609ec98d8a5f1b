#include "sonar_trial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "docent/simulator/world/survey.h"

namespace docent {
namespace {

constexpr double kSampleEvery = 0.2;     // [s]
constexpr double kStartPosition = 0.05;  // [m] how well the start is known
constexpr double kStartHeading = 0.02;   // [rad]

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

}  // namespace

SonarTrialResult run_trial(const SonarTrialOptions& options, std::ostream* trace) {
  const simulator::Office office = simulator::draw_office(options.seed);
  const simulator::Survey survey = simulator::survey(office.world, {}, Rng{options.seed}.stream("survey"));
  SonarTrialResult result;
  result.floor_area = std::abs(signed_area(office.world.floor));
  result.drive = drive_through(office, options.minutes, options.max_speed, options.seed);
  const OfficeDrive& drive = result.drive;

  localization::SonarTracker tracker{survey.map, options.tracker, drive.sonars.count};
  tracker.start_at(office.home, kStartPosition, kStartHeading);
  std::vector<double> errors;
  std::vector<double> turns;
  int within = 0;
  double next_sample = 0.0;
  for (std::size_t i = 0; i < drive.events.size(); ++i) {
    const DriveEvent& event = drive.events[i];
    if (event.sonar < 0) {
      tracker.move(event.odom_from_robot);
    } else {
      const Angle bearing = Angle::radians(2.0 * std::numbers::pi * event.sonar / drive.sonars.count);
      const Point2 place = drive.sonars.ring_radius * unit(bearing);
      tracker.hear({event.sonar, {place.x, place.y, bearing}, event.range, drive.sonars.max_range},
                   event.odom_from_robot);
    }
    if (event.time < next_sample) continue;
    next_sample += kSampleEvery;
    const auto off = localization::difference(tracker.map_from_robot(), drive.truth[i]);
    errors.push_back(std::hypot(off[0], off[1]));
    turns.push_back(std::abs(off[2]));
    const localization::PoseMatrix covariance = tracker.covariance();
    const double determinant = covariance[0] * covariance[4] - covariance[1] * covariance[3];
    const double squared =
        (covariance[4] * off[0] * off[0] - 2.0 * covariance[1] * off[0] * off[1] + covariance[0] * off[1] * off[1]) /
        determinant;
    if (squared <= 9.0) ++within;
    if (trace != nullptr) {
      *trace << event.time << ' ' << drive.truth[i].x << ' ' << drive.truth[i].y << ' '
             << drive.truth[i].theta.radians() << ' ' << off[0] << ' ' << off[1] << ' ' << off[2] << ' '
             << std::sqrt(covariance[0]) << ' ' << std::sqrt(covariance[4]) << ' ' << std::sqrt(covariance[8]) << ' '
             << tracker.tally().matched << ' ' << tracker.tally().unlike << ' ' << tracker.tally().ambiguous << ' '
             << tracker.tally().too_far << '\n';
    }
  }
  result.mean_error = mean(errors);
  result.p95_error = quantile(errors, 0.95);
  result.max_error = quantile(errors, 1.0);
  result.mean_turn = mean(turns);
  result.p95_turn = quantile(turns, 0.95);
  result.within_three = errors.empty() ? 0.0 : static_cast<double>(within) / static_cast<double>(errors.size());
  result.tally = tracker.tally();
  result.drive.events.clear();
  result.drive.truth.clear();
  return result;
}

}  // namespace docent
