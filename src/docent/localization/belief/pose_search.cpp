#include "docent/localization/belief/pose_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "docent/localization/belief/neighbourhood.h"

namespace docent::localization {
namespace {

constexpr double kStep = 0.1;                           // [m]
constexpr double kTurnStep = std::numbers::pi / 180.0;  // [rad]
constexpr double kFarthest = 2.0;                       // [m]
constexpr double kFarthestTurn = 20.0 * kTurnStep;      // [rad]
constexpr double kDeviations = 3.0;                     // of a guess that are searched
constexpr double kMostSurprise = 6.0;                   // [nat] that a guess may speak against a pose
constexpr double kSigma = 0.1;                          // [m] of a reading's end, steps of the search included
constexpr double kUnmapped = 0.1;                       // share of readings that end on what the map does not hold
constexpr std::size_t kMostReadings = 80;
constexpr std::size_t kFewestReadings = 10;
constexpr std::size_t kEntries = 64;  // of the score's table, 1 cm each

std::vector<Point2> ends(const sensor_models::RangeSweep& sweep, double max_range) {
  std::vector<Point2> all;
  for (const sensor_models::SweepBeam& beam : sweep.beams)
    if (!beam.no_return && beam.range < max_range && beam.range >= 0.3) all.push_back(sensor_models::endpoint(beam));
  const std::size_t step = (all.size() + kMostReadings - 1) / kMostReadings;
  std::vector<Point2> some;
  for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(step, 1)) some.push_back(all[i]);
  return some;
}

/// ln of how well a reading's end fits a wall so far away, by the centimetre.
std::array<double, kEntries> score_by_distance() {
  std::array<double, kEntries> scores{};
  for (std::size_t i = 0; i < kEntries; ++i) {
    const double scaled = 0.01 * static_cast<double>(i) / kSigma;
    scores[i] = std::log(kUnmapped + (1.0 - kUnmapped) * std::exp(-0.5 * scaled * scaled));
  }
  return scores;
}

double log_density(const PoseGuess& guess, Point2 position, double heading) {
  const double off = distance(position, guess.map_from_robot.position()) / guess.position_deviation;
  const double turned = (Angle::radians(heading) - guess.map_from_robot.theta).radians() / guess.heading_deviation;
  const double nats = 0.5 * (off * off + turned * turned);
  return -kMostSurprise * nats / (kMostSurprise + nats);
}

struct Scoring {
  std::span<const PoseGuess> guesses;
  const sensor_models::RayCaster& caster;
  double share;  ///< of a reading's nats that count
  std::array<double, kEntries> by_distance;

  /// `arms`: the readings' ends seen from the robot, turned into the map's directions.
  [[nodiscard]] double operator()(Point2 at, double heading, std::span<const Point2> arms) const {
    double sum = 0.0;
    for (const Point2& arm : arms) {
      const double entry = 100.0 * static_cast<double>(caster.clearance(at + arm));
      sum += by_distance[entry < kEntries - 1 ? static_cast<std::size_t>(entry) : kEntries - 1];
    }
    sum *= share;
    for (const PoseGuess& guess : guesses) sum += log_density(guess, at, heading);
    return sum;
  }
};

struct Scored {
  Pose2 pose;
  double score;
};

/// The box about one guess; adds every pose that the robot may have there.
void search(const PoseGuess& guess, std::span<const Point2> seen, const Scoring& scoring,
            std::vector<Scored>& searched) {
  const int aside = static_cast<int>(std::ceil(std::min(kFarthest, kDeviations * guess.position_deviation) / kStep));
  const int turns =
      static_cast<int>(std::ceil(std::min(kFarthestTurn, kDeviations * guess.heading_deviation) / kTurnStep));
  std::vector<Point2> arms(seen.size());
  for (int turn = -turns; turn <= turns; ++turn) {
    const double heading = guess.map_from_robot.theta.radians() + turn * kTurnStep;
    const Pose2 turned{0.0, 0.0, Angle::radians(heading)};
    for (std::size_t i = 0; i < seen.size(); ++i) arms[i] = turned * seen[i];
    for (int row = -aside; row <= aside; ++row) {
      for (int column = -aside; column <= aside; ++column) {
        const Point2 at = guess.map_from_robot.position() + Point2{column * kStep, row * kStep};
        if (scoring.caster.clearance(at) < static_cast<float>(kStep)) continue;
        searched.push_back({{at.x, at.y, turned.theta}, scoring(at, heading, arms)});
      }
    }
  }
}

}  // namespace

FoundPose best_pose_near(std::span<const PoseGuess> guesses, const sensor_models::RangeSweep& sweep,
                         const sensor_models::RayCaster& caster, double max_range, double readings) {
  const Pose2& first = guesses.front().map_from_robot;
  const std::vector<Point2> seen = ends(sweep, max_range);
  if (seen.size() < kFewestReadings) return {first, 0.0};
  const Scoring scoring{guesses, caster, std::min(1.0, readings / static_cast<double>(seen.size())),
                        score_by_distance()};
  std::vector<Scored> searched;
  for (const PoseGuess& guess : guesses) search(guess, seen, scoring, searched);
  if (searched.empty()) return {first, 0.0};
  const auto best = *std::max_element(searched.begin(), searched.end(),
                                      [](const Scored& a, const Scored& b) { return a.score < b.score; });
  const Neighbourhood same = same_place(best.pose);
  double in_same = 0.0;
  double in_all = 0.0;
  for (const Scored& one : searched) {
    const double weight = std::exp(one.score - best.score);
    in_all += weight;
    if (same.holds(one.pose.position()) && same.holds(one.pose.theta)) in_same += weight;
  }
  return {best.pose, in_same / in_all};
}

std::optional<double> log_fit(const Pose2& map_from_robot, const sensor_models::RangeSweep& sweep,
                              const sensor_models::RayCaster& caster, double max_range) {
  std::vector<Point2> arms = ends(sweep, max_range);
  if (arms.size() < kFewestReadings) return std::nullopt;
  const Pose2 turned{0.0, 0.0, map_from_robot.theta};
  for (Point2& arm : arms) arm = turned * arm;
  const Scoring scoring{{}, caster, 1.0 / static_cast<double>(arms.size()), score_by_distance()};
  return scoring(map_from_robot.position(), turned.theta.radians(), arms);
}

}  // namespace docent::localization
