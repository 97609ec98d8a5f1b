#include "docent/localization/sonar/evidence/sonar_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace docent::localization {

namespace {

constexpr double kBinsPerMetre = 100.0;

}  // namespace

Result<void> SonarEvidenceParams::validate() const {
  if (!(beams >= 0 && beams <= 180)) return fail("sonar.beams must be 0..180");
  if (!(independent_beams > 0.0)) return fail("sonar.independent_beams must be > 0");
  if (!(most_nats > 0.0)) return fail("sonar.most_nats must be > 0");
  if (auto known = beam_filter_of(filter); !known) return fail("sonar." + known.error().message);
  if (!(filter_sureness > 0.5 && filter_sureness < 1.0)) return fail("sonar.filter_sureness must be 0.5..1");
  if (!(unfiltered_share >= 0.0 && unfiltered_share <= 1.0)) return fail("sonar.unfiltered_share must be 0..1");
  if (!(cone > 0.0 && cone <= 180.0)) return fail("sonar.cone must be > 0 and <= 180");
  if (!(oldest > 0.0)) return fail("sonar.oldest must be > 0");
  if (auto valid = model.validate(); !valid) return fail("sonar.model." + valid.error().message);
  return {};
}

SonarEvidence::SonarEvidence(const SonarEvidenceParams& params, int sonars, const StateSpace& space,
                             const RangeTable& rays, const sensor_models::ProximityModel& rays_model,
                             std::uint64_t seed)
    : params_{params},
      filter_{beam_filter_of(params.filter).value_or(BeamFilter::distance)},
      space_{&space},
      bins_{params.model},
      table_{RangeTable::cones(rays, rays_model, space, bins_, params.cone * std::numbers::pi / 180.0)},
      model_{params.model, table_.frequency()},
      trust_{sonars},
      rng_{Rng{seed}.stream("sonar evidence")},
      ears_(static_cast<std::size_t>(sonars)) {
  const double temper = std::min(1.0, params.independent_beams / params.beams);
  costs_.reserve(static_cast<std::size_t>(sensor_models::kRangeBins) * sensor_models::kExpectedRanges);
  for (int measured = 0; measured < sensor_models::kRangeBins; ++measured) {
    const auto log_probabilities = model_.log_probabilities(measured);
    const float best = *std::max_element(log_probabilities.begin(), log_probabilities.end());
    for (const float log_probability : log_probabilities)
      costs_.push_back(static_cast<float>(temper) * (best - log_probability));
  }
  const auto steps = static_cast<std::size_t>(std::ceil(params.model.max_range * kBinsPerMetre));
  for (std::size_t i = 0; i < steps; ++i)
    bin_at_.push_back(static_cast<std::uint8_t>(
        std::min(model_.bin((static_cast<double>(i) + 0.5) / kBinsPerMetre), sensor_models::kNoReturn - 1)));
}

void SonarEvidence::hear(const SonarPing& ping) {
  if (!std::isfinite(ping.range)) return;
  if (ping.range < ping.max_range) {
    trust_.hear(ping.sonar, ping.range, ping.odom_from_base);
  } else {
    trust_.hear_nothing(ping.sonar);
  }
  ears_[static_cast<std::size_t>(ping.sonar)] = {ping, true};
}

sensor_models::RangeSweep SonarEvidence::fresh_sweep(const ObservationMoment& moment) {
  sensor_models::RangeSweep sweep;
  for (Ear& ear : ears_) {
    const double age = to_seconds(moment.time - ear.ping.time);
    if (!ear.is_new || age > params_.oldest) continue;
    ear.is_new = false;  // the same echo must not count twice
    const Pose2 base_from_then = inverse(moment.odom_from_robot) * ear.ping.odom_from_base;
    const auto range = static_cast<float>(ear.ping.range);
    sensor_models::append(sweep, {{&range, 1}, Angle{}, 0.0, 0.0, ear.ping.max_range},
                          base_from_then * ear.ping.base_from_sonar);
  }
  for (sensor_models::SweepBeam& beam : sweep.beams)
    beam.no_return = beam.no_return || beam.range >= params_.model.max_range;
  return sweep;
}

std::vector<LikelyState> SonarEvidence::states_of(std::span<const LikelyPose> likely) const {
  std::vector<LikelyState> states;
  double total = 0.0;
  for (const LikelyPose& pose : likely) {
    const std::int32_t place = space_->place_at(space_->frame().cell_at(pose.map_from_robot.position()));
    if (place == StateSpace::kNoPlace) continue;
    const int heading = static_cast<int>(std::lround(heading_steps(pose.map_from_robot.theta))) % space_->headings();
    states.push_back({place, heading, static_cast<float>(pose.mass)});
    total += pose.mass;
  }
  for (LikelyState& state : states) state.mass = static_cast<float>(static_cast<double>(state.mass) / total);
  return states;
}

double SonarEvidence::heading_steps(Angle angle) const {
  const double steps = angle.radians() / space_->heading_step();
  return steps < 0.0 ? steps + space_->headings() : steps;
}

Agreement SonarEvidence::compare(const ExpectedRanges& expected, int direction, int bin) const {
  if (bin != sensor_models::kNoReturn) return agreement(expected, model_, direction, bin, params_.filter_sureness);
  // An echo that is expected well within reach and does not come.
  constexpr double kWithinReach = 0.6;
  Agreement result;
  const auto masses = expected.masses(direction);
  const int reach = model_.bin(kWithinReach * params_.model.max_range);
  for (int o = 0; o < reach; ++o) result.longer += static_cast<double>(masses[static_cast<std::size_t>(o)]);
  return result;
}

std::vector<sensor_models::BinnedBeam> SonarEvidence::filtered(const sensor_models::RangeSweep& sweep,
                                                               std::span<const LikelyPose> likely) {
  std::vector<sensor_models::BinnedBeam> beams = sensor_models::binned(sweep, space_->headings());
  filtered_ = 0;
  const std::vector<LikelyState> states = states_of(likely);
  if (states.empty()) return beams;
  const ExpectedRanges expected{states, table_, space_->headings(), asks_entropy(filter_)};
  std::vector<sensor_models::BinnedBeam> kept;
  Agreement readings;
  for (const sensor_models::BinnedBeam& beam : beams) {
    const int bin = bin_of(sweep.beams[beam.beam]);
    readings += compare(expected, beam.direction, bin);
    const bool rejected = rejects(filter_, expected, model_, beam.direction, bin, params_.filter_sureness);
    filtered_ += rejected ? 1 : 0;
    if (!rejected || rng_.chance(params_.unfiltered_share)) kept.push_back(beam);
  }
  trust_.compare(readings);
  return kept;
}

bool SonarEvidence::observe(const ObservationMoment& moment) {
  const sensor_models::RangeSweep sweep = fresh_sweep(moment);
  const auto chosen =
      sensor_models::thinned(filtered(sweep, moment.likely), static_cast<std::size_t>(params_.beams), ++phase_);
  beams_.clear();
  if (trust_.state() != SonarTrust::State::well && !params_.trusting) return false;
  for (const sensor_models::BinnedBeam& beam : chosen) {
    const sensor_models::SweepBeam& reading = sweep.beams[beam.beam];
    const Angle bearing = Angle::radians(reading.bearing);
    beams_.push_back({reading.range, unit(bearing), heading_steps(bearing), bin_of(reading)});
  }
  return !beams_.empty();
}

float SonarEvidence::cost_at(const Pose2& map_from_robot) const {
  const auto most = static_cast<float>(params_.most_nats);
  const std::int32_t place = space_->place_at(space_->frame().cell_at(map_from_robot.position()));
  if (place == StateSpace::kNoPlace) return most;
  // Readings are carried to the middle of the cell, for which the table was made: see BeamScores.
  const Point2 off = map_from_robot.position() - space_->centre(static_cast<std::size_t>(place));
  const Point2 ahead = unit(map_from_robot.theta);
  const double along = dot(ahead, off);
  const double aside = cross(ahead, off);
  const RangeTable::Row row = table_.row(static_cast<std::size_t>(place));
  const double heading = heading_steps(map_from_robot.theta) + 0.5;
  const auto headings = static_cast<std::size_t>(space_->headings());
  const auto last = static_cast<double>(bin_at_.size() - 1);
  float sum = 0.0F;
  for (const Beam& beam : beams_) {
    auto measured = static_cast<std::size_t>(beam.bin);
    if (beam.bin != sensor_models::kNoReturn) {
      const double range = beam.range + along * beam.along.x + aside * beam.along.y;
      measured = bin_at_[static_cast<std::size_t>(std::clamp(range * kBinsPerMetre, 0.0, last))];
    }
    const auto direction = static_cast<std::size_t>(heading + beam.direction) % headings;
    sum += costs_[measured * sensor_models::kExpectedRanges + row[direction]];
  }
  return std::min(sum, most);
}

void SonarEvidence::add_costs(std::span<const Pose2> map_from_robot, std::span<float> nats) const {
  for (std::size_t i = 0; i < map_from_robot.size(); ++i) nats[i] += cost_at(map_from_robot[i]);
}

double SonarEvidence::mean_cost() const {
  const double temper = std::min(1.0, params_.independent_beams / params_.beams);
  double sum = 0.0;
  for (const Beam& beam : beams_) {
    const auto log_probabilities = model_.log_probabilities(beam.bin);
    const float best = *std::max_element(log_probabilities.begin(), log_probabilities.end());
    sum += temper * (static_cast<double>(best) - model_.log_mean_probability(beam.bin));
  }
  return std::min(sum, params_.most_nats);
}

}  // namespace docent::localization
