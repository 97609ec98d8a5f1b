#include "docent/localization/monte_carlo/sweep_scores.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace docent::localization {

SweepScores::SweepScores(Model model, BeamScores beams, LikelihoodField field, int headings, std::size_t sectors,
                         double most_sector_nats, double max_range)
    : model_{model},
      beams_{std::move(beams)},
      field_{std::move(field)},
      kernel_{field_kernels().back().kernel},
      headings_{static_cast<std::size_t>(headings)},
      sectors_{sectors},
      cap_{static_cast<std::uint32_t>(std::min(most_sector_nats * kScorePerNat, 1e6))},
      max_range_{max_range} {}

void SweepScores::score(const sensor_models::RangeSweep& sweep, std::span<const sensor_models::BinnedBeam> beams,
                        const ParticleSet& particles, std::vector<std::uint32_t>& costs) const {
  costs.resize(particles.padded_size());
  BeamScores::Beams ranges;
  FieldBeams ends;
  ranges.cap = ends.cap = cap_;
  const double per_radian = static_cast<double>(headings_) / (2.0 * std::numbers::pi);
  const auto sector = [&](std::size_t i) { return beams[i].direction * sectors_ / headings_; };
  for (std::size_t i = 0; i < beams.size(); ++i) {
    const sensor_models::SweepBeam& beam = sweep.beams[beams[i].beam];
    const bool no_return = beam.no_return || beam.range >= max_range_;
    const Point2 along = unit(Angle::radians(beam.bearing));
    double direction = beam.bearing * per_radian;
    if (direction < 0.0) direction += static_cast<double>(headings_);
    ranges.beams.push_back({static_cast<float>(beam.range), static_cast<float>(along.x), static_cast<float>(along.y),
                            static_cast<float>(direction), no_return ? beams_.nothing_up_to(beam.range) : -1});
    if (!no_return) ends.add(field_.view(), beam.range * along);
    if (i + 1 < beams.size() && sector(i + 1) == sector(i)) continue;
    ranges.ends.push_back(static_cast<std::uint32_t>(ranges.beams.size()));
    ends.close_sector();
  }
  if (model_ == Model::beam) {
    beams_.score(ranges, particles, costs.data());
    return;
  }
  FieldPoses poses;
  poses.fill(field_.view(), particles);
  kernel_(field_.view(), ends, poses, costs.data());
}

}  // namespace docent::localization
