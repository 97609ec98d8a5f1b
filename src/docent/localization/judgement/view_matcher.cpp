#include "docent/localization/judgement/view_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace docent::localization {
namespace {

constexpr double kSigma = 0.12;    // [m] of a reading's end
constexpr double kUnmapped = 0.1;  // share of readings that end on what the map does not hold
constexpr double kWorth = 15.0;    // independent readings
constexpr std::size_t kMost = 60;
constexpr std::size_t kFewest = 10;
constexpr double kFinest = 0.02;  // [m]
constexpr std::size_t kEntries = 64;

/// ln of how well a reading's end fits a wall so far away, by the centimetre.
const std::array<float, kEntries>& fit_by_distance() {
  static const auto kFits = [] {
    std::array<float, kEntries> fits{};
    for (std::size_t i = 0; i < kEntries; ++i) {
      const double scaled = 0.01 * static_cast<double>(i) / kSigma;
      fits[i] = static_cast<float>(std::log(kUnmapped + (1.0 - kUnmapped) * std::exp(-0.5 * scaled * scaled)));
    }
    return fits;
  }();
  return kFits;
}

class Score {
 public:
  Score(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep, double max_range,
        const Pose2& guess, const GuessError& error)
      : caster_{caster}, guess_{guess}, error_{error} {
    const std::size_t step = std::max<std::size_t>(1, (sweep.beams.size() + kMost - 1) / kMost);
    for (std::size_t i = 0; i < sweep.beams.size(); i += step) {
      const sensor_models::SweepBeam& beam = sweep.beams[i];
      if (!beam.no_return && beam.range < max_range) ends_.push_back(sensor_models::endpoint(beam));
    }
  }
  [[nodiscard]] bool can_tell() const { return ends_.size() >= kFewest; }
  [[nodiscard]] double operator()(const Pose2& pose) const {
    if (caster_.clearance(pose.position()) < 0.1F) return -1e9;
    double sum = 0.0;
    const Point2 ahead = unit(pose.theta);
    for (const Point2& end : ends_) {
      const Point2 at{pose.x + ahead.x * end.x - ahead.y * end.y, pose.y + ahead.y * end.x + ahead.x * end.y};
      const double entry = 100.0 * static_cast<double>(caster_.clearance(at));
      sum +=
          static_cast<double>(fit_by_distance()[entry < kEntries - 1 ? static_cast<std::size_t>(entry) : kEntries - 1]);
    }
    const double off = distance(pose.position(), guess_.position()) / error_.position;
    const double turned = (pose.theta - guess_.theta).radians() / error_.heading;
    return sum * kWorth / static_cast<double>(ends_.size()) - 0.5 * (off * off + turned * turned);
  }

 private:
  const sensor_models::RayCaster& caster_;
  Pose2 guess_;
  GuessError error_;
  std::vector<Point2> ends_;
};

}  // namespace

GuessError guess_error(const motion_models::OdometryModelParams& motion, const Pose2& step) {
  const motion_models::MotionNoise noise = motion_models::motion_noise(motion, step);
  return {kMatchError.position + std::sqrt(noise.position_variance),
          kMatchError.heading + std::sqrt(noise.heading_variance)};
}

bool is_same_place(const Pose2& a, const Pose2& b) {
  return distance(a.position(), b.position()) < 0.5 && std::abs((a.theta - b.theta).degrees()) < 15.0;
}

sensor_models::RangeSweep thinned(const sensor_models::RangeSweep& sweep, int most) {
  sensor_models::RangeSweep some;
  const double step = std::max(1.0, static_cast<double>(sweep.beams.size()) / most);
  for (double i = 0.5 * (step - 1.0); i < static_cast<double>(sweep.beams.size()); i += step)
    some.beams.push_back(sweep.beams[static_cast<std::size_t>(i)]);
  return some;
}

Pose2 matched(const sensor_models::RayCaster& caster, const sensor_models::RangeSweep& sweep, double max_range,
              const Pose2& guess, const GuessError& error) {
  const Score score{caster, sweep, max_range, guess, error};
  if (!score.can_tell()) return guess;
  Pose2 best = guess;
  double most = score(guess);
  const auto try_at = [&](const Pose2& pose) {
    const double of_pose = score(pose);
    if (of_pose <= most) return false;
    most = of_pose;
    best = pose;
    return true;
  };
  for (int turn = -2; turn <= 2; ++turn)
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        try_at({guess.x + 1.2 * error.position * x, guess.y + 1.2 * error.position * y,
                guess.theta + Angle::radians(error.heading * turn)});
  double step = 0.6 * error.position;
  double turn = 0.5 * error.heading;
  for (int round = 0; round < 12 && step > kFinest; ++round) {
    const Pose2 from = best;
    bool has_moved = false;
    for (const double sign : {-1.0, 1.0}) {
      has_moved = try_at({from.x + sign * step, from.y, from.theta}) || has_moved;
      has_moved = try_at({from.x, from.y + sign * step, from.theta}) || has_moved;
      has_moved = try_at({from.x, from.y, from.theta + Angle::radians(sign * turn)}) || has_moved;
    }
    if (has_moved) continue;
    step *= 0.5;
    turn *= 0.5;
  }
  return best;
}

}  // namespace docent::localization
