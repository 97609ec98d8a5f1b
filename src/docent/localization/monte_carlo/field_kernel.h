#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "docent/localization/monte_carlo/likelihood_field.h"
#include "docent/localization/monte_carlo/particle_set.h"

namespace docent {

/// The ends of beams, sector by sector: what stands in one direction hides several, so that the beams of a sector cost
/// at most `cap` together (decision 0006).
struct FieldBeams {
  std::vector<float> x, y;          ///< [cells], robot frame; not longer than the field's reach
  std::vector<std::uint32_t> ends;  ///< of each sector: index behind its last beam
  std::uint32_t cap = 1U << 30U;
};

/// costs[i] = sum over sectors of min(cap, sum over its beams of the field's cost at the beam's end seen from particle
/// i), for all particles and the padding. Sector by sector, so that the part of the field that a sector's beams hit
/// stays in the first cache; there 16 particles a vector. `costs` has padded_size() entries.
using FieldKernel = void (*)(const LikelihoodField::View& field, const FieldBeams& beams, const ParticleSet& particles,
                             std::uint32_t* costs);

/// The kernels this processor can run, the plain one first, the fastest last. They agree bit for bit: the same
/// additions and products in float, none fused, and whole-number sums.
struct NamedFieldKernel {
  std::string name;
  FieldKernel kernel;
};
[[nodiscard]] std::vector<NamedFieldKernel> field_kernels();

}  // namespace docent
