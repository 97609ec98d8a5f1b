#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "docent/base/random.h"
#include "docent/base/time.h"
#include "docent/geometry/polygon.h"
#include "docent/localization/expected_ranges/range_table.h"
#include "docent/localization/markov/position_belief.h"
#include "docent/sensor_models/range_sweep.h"

/// Worlds and readings for the tests of this folder.
namespace docent::localization::testing {

/// A room of 6 x 4 m without symmetry, as a grid of 5 cm.
inline OccupancyGrid room_map() {
  OccupancyGrid map;
  map.frame = {120, 80, 0.05, {}};
  map.cells.assign(map.frame.size(), OccupancyGrid::kFree);
  const auto fill = [&map](int left, int bottom, int right, int top) {
    for (int row = bottom; row < top; ++row)
      for (int column = left; column < right; ++column)
        map.cells[map.frame.index({column, row})] = OccupancyGrid::kOccupied;
  };
  fill(0, 0, 120, 2), fill(0, 78, 120, 80), fill(0, 0, 2, 80), fill(118, 0, 120, 80);
  fill(60, 0, 64, 30);   // a wall from below
  fill(20, 60, 40, 70);  // a case
  fill(95, 10, 118, 20);
  fill(80, 62, 84, 80);
  return map;
}

/// The room with what a belief needs; coarse headings keep tests fast.
struct Room {
  OccupancyGrid map = room_map();
  sensor_models::RayCaster caster{map};
  StateSpace space;
  RangeTable table;
  sensor_models::ProximityModel model;
  explicit Room(double heading_step = 6.0)
      : space{map, caster, {.cell_size = 0.15, .heading_step = heading_step, .min_clearance = 0.1}},
        table{RangeTable::build(space, caster, sensor_models::ProximityModel{{}})},
        model{{}, table.frequency()} {}
};
inline std::unique_ptr<Room> drawn_room() { return std::make_unique<Room>(); }

/// In the order of directions, as a belief wants them.
inline std::vector<BeamCosts> any_beams(Rng& rng, int count, int headings) {
  std::vector<BeamCosts> beams(static_cast<std::size_t>(count));
  for (BeamCosts& beam : beams) {
    for (auto& cost : beam.costs) cost = static_cast<std::uint8_t>(rng.integer(0, kMaxCost));
    beam.direction = static_cast<std::size_t>(rng.integer(0, headings - 1));
  }
  std::sort(beams.begin(), beams.end(), [](const auto& a, const auto& b) { return a.direction < b.direction; });
  return beams;
}

/// What a perfect laser sees at `truth`, one beam a degree.
inline sensor_models::RangeSweep sweep_at(const sensor_models::RayCaster& caster, const Pose2& truth,
                                          double max_range) {
  sensor_models::RangeSweep sweep;
  for (int degree = -180; degree < 180; ++degree) {
    const Angle bearing = Angle::degrees(degree);
    const double range =
        caster.cast(truth.position(), unit(truth.theta + bearing), max_range, 0.3).value_or(max_range) + 0.025;
    sweep.beams.push_back({bearing.radians(), std::min(range, max_range), range >= max_range});
  }
  return sweep;
}

/// A robot that turns on the spot in a ring of people who stand round it: of the room it sees what the gaps between
/// them show.
class Surrounded {
 public:
  Surrounded(const sensor_models::RayCaster& caster, std::uint64_t seed)
      : caster_{caster}, rng_{Rng{seed}.stream("surrounded")} {
    do {
      truth_ = {rng_.uniform(0.5, 5.5), rng_.uniform(0.5, 3.5), Angle::degrees(rng_.uniform(-180.0, 180.0))};
    } while (caster.clearance(truth_.position()) < 0.8F);
    for (double degrees = 0.0; degrees < 345.0; degrees += rng_.uniform(34.0, 46.0)) {
      const Point2 off = rng_.uniform(0.75, 1.05) * unit(Angle::degrees(degrees));
      people_.push_back(truth_.position() + off);
    }
  }
  void turn() {
    truth_.theta = truth_.theta + Angle::degrees(12.0);
    odom_.theta = odom_.theta + Angle::degrees(12.0 + rng_.normal(0.0, 0.2));
    time_ = time_ + seconds(0.4);
  }
  [[nodiscard]] sensor_models::RangeSweep look() {
    constexpr double kBody = 0.24;  // [m]
    sensor_models::RangeSweep sweep = sweep_at(caster_, truth_, 10.0);
    for (sensor_models::SweepBeam& beam : sweep.beams) {
      const Point2 ray = unit(truth_.theta + Angle::radians(beam.bearing));
      for (const Point2 person : people_) {
        const auto range = ray_distance(truth_.position(), ray, person, kBody);
        if (range && *range < beam.range) beam = {beam.bearing, *range, false};
      }
      beam.range += beam.no_return ? 0.0 : rng_.normal(0.0, 0.02);
    }
    return sweep;
  }
  [[nodiscard]] bool is_here(const std::optional<Pose2>& found) const {
    return found && distance(found->position(), truth_.position()) < 0.5 &&
           std::abs((found->theta - truth_.theta).degrees()) < 20.0;
  }
  [[nodiscard]] const Pose2& odom() const { return odom_; }
  [[nodiscard]] Time time() const { return time_; }

 private:
  const sensor_models::RayCaster& caster_;
  Rng rng_;
  Pose2 truth_;
  Pose2 odom_{};
  Time time_ = time_from_seconds(100.0);
  std::vector<Point2> people_;
};

/// Of `trials` robots that stand surrounded and have turned twice. `localizer_of` makes a localizer for a seed.
struct LookingRound {
  int likeliest = 0;  ///< whose best pose is right
  int sure = 0;       ///< who say so, too
  int wrong = 0;      ///< who ever said that they were elsewhere
};
inline LookingRound look_round(const sensor_models::RayCaster& caster, int trials, const auto& localizer_of) {
  LookingRound result;
  for (int trial = 0; trial < trials; ++trial) {
    Surrounded robot{caster, static_cast<std::uint64_t>(trial)};
    auto localizer = localizer_of(static_cast<std::uint64_t>(trial));
    const auto is_here = [&] { return robot.is_here(localizer->map_from_robot(robot.odom())); };
    bool was_wrong = false;
    for (int step = 0; step < 60; ++step) {
      localizer->observe(robot.look(), robot.odom(), robot.time());
      was_wrong = was_wrong || (localizer->verdict().localized() && !is_here());
      robot.turn();
    }
    const bool is_right = is_here();
    result.likeliest += is_right ? 1 : 0;
    result.sure += is_right && localizer->verdict().localized() ? 1 : 0;
    result.wrong += was_wrong ? 1 : 0;
  }
  return result;
}

/// The costs of that reading, tempered by `temper`.
inline std::vector<BeamCosts> beams_at(const Room& room, const Pose2& truth, double temper,
                                       double& log_best_over_mean) {
  const sensor_models::RangeSweep sweep = sweep_at(room.caster, truth, 10.0);
  std::vector<BeamCosts> beams;
  log_best_over_mean = 0.0;
  for (const sensor_models::BinnedBeam& binned_beam : sensor_models::binned(sweep, room.space.headings())) {
    const int bin = room.model.bin(sweep.beams[binned_beam.beam].range);
    const auto log_probabilities = room.model.log_probabilities(bin);
    const float best = *std::max_element(log_probabilities.begin(), log_probabilities.end());
    BeamCosts beam;
    for (std::size_t o = 0; o < beam.costs.size(); ++o)
      beam.costs[o] = static_cast<std::uint8_t>(std::min<long>(
          kMaxCost, std::lround(temper * static_cast<double>(best - log_probabilities[o]) * kCostPerNat)));
    beam.direction = binned_beam.direction;
    log_best_over_mean += temper * (static_cast<double>(best) - room.model.log_mean_probability(bin));
    beams.push_back(beam);
  }
  return beams;
}

}  // namespace docent::localization::testing
