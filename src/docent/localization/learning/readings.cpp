#include "docent/localization/learning/readings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace docent::localization {

int Expectation::expected(const Pose2& map_from_sensor, std::size_t place, double bearing) const {
  if (at_ == ExpectedAt::pose) {
    const Angle direction = map_from_sensor.theta + Angle::radians(bearing);
    const auto range = caster_.cast(map_from_sensor.position(), unit(direction), bins_.max_range(), kUnknownAllowance);
    if (!range) return sensor_models::kUnknownRange;
    return *range >= bins_.max_range() ? sensor_models::kNoReturn
                                       : bins_.bin(*range + 0.5 * caster_.frame().resolution);
  }
  const int headings = space_.headings();
  const auto steps = [&](double angle) { return static_cast<int>(std::lround(angle / space_.heading_step())); };
  const int heading = (steps(map_from_sensor.theta.radians()) + steps(bearing) + 2 * headings) % headings;
  return table_.row(place)[static_cast<std::size_t>(heading)];
}

void Expectation::add(const sensor_models::RangeSweep& sweep, const Pose2& map_from_sensor,
                      sensor_models::ReadingCounts& counts) const {
  const std::int32_t place = space_.place_at(space_.frame().cell_at(map_from_sensor.position()));
  if (place == StateSpace::kNoPlace) return;
  for (const sensor_models::BinnedBeam& chosen : sensor_models::binned(sweep, space_.headings())) {
    const sensor_models::SweepBeam& beam = sweep.beams[chosen.beam];
    const int measured = beam.no_return ? sensor_models::kNoReturn : bins_.bin(beam.range);
    counts.add(measured, expected(map_from_sensor, static_cast<std::size_t>(place), beam.bearing));
  }
}

Pieces pieces_of(std::span<const RecordedSweep> sweeps) {
  std::vector<double> along;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const Pose2 step = i == 0 ? Pose2{} : inverse(sweeps[i - 1].odom_from_base) * sweeps[i].odom_from_base;
    const double effort = norm(step.position()) + 0.5 * std::abs(step.theta.radians());
    along.push_back((i == 0 ? 0.0 : along.back()) + effort);
  }
  Pieces pieces;
  if (along.empty()) return pieces;
  const double length = std::clamp(along.back() / 16.0, 2.0, 10.0);
  for (const double way : along) pieces.piece.push_back(static_cast<int>(way / length));
  pieces.count = pieces.piece.back() + 1;
  return pieces;
}

CountedReadings count_readings(std::span<const RecordedSweep> sweeps, std::span<const RecordedSweep> guide,
                               std::span<const PoseLabel> labels, const Pieces& pieces, const Expectation& expectation,
                               const ReadingParams& params) {
  const sensor_models::ReadingCounts none{expectation.bins().max_range()};
  CountedReadings result{none, {}, 0};
  std::map<int, sensor_models::ReadingCounts> held_out;
  std::map<int, Pose2> last_counted;  // odom_from_base by sensor
  std::size_t at = 0;                 // the guide's sweep at or before the reading
  for (const RecordedSweep& recorded : sweeps) {
    while (at + 1 < guide.size() && guide[at + 1].time <= recorded.time) ++at;
    if (at >= guide.size() || !labels[at].sure) continue;
    if (std::abs(to_seconds(recorded.time - guide[at].time)) > params.longest_carry) continue;
    const auto last = last_counted.find(recorded.sensor);
    if (last != last_counted.end()) {
      const Pose2 moved = inverse(last->second) * recorded.odom_from_base;
      const double turned = std::abs(moved.theta.degrees());
      if (norm(moved.position()) < params.step_way && turned < params.step_turn) continue;
    }
    last_counted[recorded.sensor] = recorded.odom_from_base;
    const Pose2 label_from_base = inverse(guide[at].odom_from_base) * recorded.odom_from_base;
    const Pose2 map_from_sensor = labels[at].map_from_base * label_from_base * recorded.base_from_sensor;
    const int piece = pieces.piece[at];
    sensor_models::ReadingCounts& counts =
        Pieces::is_held_out(piece) ? held_out.try_emplace(piece, none).first->second : result.fitted;
    expectation.add(recorded.sweep, map_from_sensor, counts);
    ++result.sweeps;
  }
  for (auto& [piece, counts] : held_out)
    if (counts.total() > 0) result.held_out.push_back(std::move(counts));
  return result;
}

}  // namespace docent::localization
