#include "docent/localization/monte_carlo/beam_scores.h"

#include <algorithm>
#include <cmath>

namespace docent::localization {

BeamScores::BeamScores(const StateSpace& space, const RangeTable& table, const sensor_models::ProximityModel& model,
                       double max_range)
    : space_{&space}, table_{&table}, model_{&model} {
  const auto steps = static_cast<std::size_t>(std::ceil(max_range * kBinsPerMetre));
  for (std::size_t i = 0; i < steps; ++i)
    bins_.push_back(static_cast<std::uint8_t>(
        std::min(model.bin((static_cast<double>(i) + 0.5) / kBinsPerMetre), sensor_models::kNoReturn - 1)));
  costs_.resize(static_cast<std::size_t>(sensor_models::kMeasurements) * sensor_models::kExpectedRanges);
  for (int measured = 0; measured < sensor_models::kMeasurements; ++measured) {
    const auto log_probabilities = model.log_probabilities(measured);
    const float best = *std::max_element(log_probabilities.begin(), log_probabilities.end());
    for (std::size_t o = 0; o < sensor_models::kExpectedRanges; ++o)
      costs_[static_cast<std::size_t>(measured) * sensor_models::kExpectedRanges + o] = static_cast<std::uint8_t>(
          std::min<long>(255, std::lround(static_cast<double>(best - log_probabilities[o]) * kScorePerNat)));
  }
}

std::uint32_t BeamScores::score_one(const Beams& beams, const RangeTable::Row& row, float heading, float ahead,
                                    float aside) const {
  const auto last = static_cast<std::int32_t>(bins_.size()) - 1;
  std::uint32_t total = 0;
  std::size_t b = 0;
  for (const std::uint32_t end : beams.ends) {
    std::uint32_t sum = 0;
    for (; b < end; ++b) {
      const Beams::Beam& beam = beams.beams[b];
      const float range = beam.range + ahead * beam.x + aside * beam.y;
      const auto step = std::clamp(static_cast<std::int32_t>(range * static_cast<float>(kBinsPerMetre)), 0, last);
      const std::size_t measured = beam.nothing_up_to >= 0 ? static_cast<std::size_t>(beam.nothing_up_to)
                                                           : bins_[static_cast<std::size_t>(step)];
      const std::size_t expected = row[static_cast<std::size_t>(heading + beam.direction)] & 127U;
      sum += costs_[measured * sensor_models::kExpectedRanges + expected];
    }
    total += std::min(sum, beams.cap);
  }
  return total;
}

void BeamScores::score(const Beams& beams, const ParticleSet& particles, std::uint32_t* costs) const {
  const double steps_per_radian = 1.0 / space_->heading_step();
  const double turn = space_->headings();
  const auto nowhere = static_cast<std::uint32_t>(
      std::min<std::size_t>(beams.cap * beams.ends.size(), beams.beams.size() * std::size_t{255}));
  std::fill_n(costs, particles.padded_size(), nowhere);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Pose2 pose = particles.pose(i);
    const std::int32_t place = space_->place_at(space_->frame().cell_at(pose.position()));
    if (place == StateSpace::kNoPlace) continue;
    const Point2 off = pose.position() - space_->centre(static_cast<std::size_t>(place));
    const double c = static_cast<double>(particles.heading_x[i]);
    const double s = static_cast<double>(particles.heading_y[i]);
    double heading = pose.theta.radians() * steps_per_radian;
    heading += heading < 0.0 ? turn + 0.5 : 0.5;  // to the nearest by cutting off
    if (heading >= turn) heading -= turn;
    heading = std::min(heading, turn - 1e-3);  // with a beam's direction below two turns, in float as well
    costs[i] = score_one(beams, table_->row(static_cast<std::size_t>(place)), static_cast<float>(heading),
                         static_cast<float>(c * off.x + s * off.y), static_cast<float>(c * off.y - s * off.x));
  }
}

}  // namespace docent::localization
