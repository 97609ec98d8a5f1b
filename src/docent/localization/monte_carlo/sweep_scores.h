#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "docent/localization/monte_carlo/beam_scores.h"
#include "docent/localization/monte_carlo/field_kernel.h"
#include "docent/sensor_models/range_sweep.h"

namespace docent::localization {

/// What the chosen beams of a sweep say of particles, by the beam model or by the likelihood field.
class SweepScores {
 public:
  enum class Model { beam, field };

  SweepScores(Model model, BeamScores beams, LikelihoodField field, int headings, std::size_t sectors,
              double most_sector_nats, double max_range);

  /// Costs in steps of 1 / kScorePerNat below a perfect fit; the beams of a sector together at most the sector's cap.
  /// `beams`: by rising direction. The field has nothing to say of beams without a return. `costs` is made as long as
  /// the particles with their padding. O(particles * beams).
  void score(const sensor_models::RangeSweep& sweep, std::span<const sensor_models::BinnedBeam> beams,
             const ParticleSet& particles, std::vector<std::uint32_t>& costs) const;
  /// For tests and benchmarks: an instruction set by hand.
  void use_kernel(FieldKernel kernel) { kernel_ = kernel; }

 private:
  Model model_;
  BeamScores beams_;
  LikelihoodField field_;
  FieldKernel kernel_;
  std::size_t headings_;
  std::size_t sectors_;
  std::uint32_t cap_;
  double max_range_;
};

}  // namespace docent::localization
