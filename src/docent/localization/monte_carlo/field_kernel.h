#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "docent/localization/monte_carlo/likelihood_field.h"
#include "docent/localization/particles/particle_set.h"

namespace docent::localization {

/// The ends of beams, sector by sector: what stands in one direction hides several, so that the beams of a sector cost
/// at most `cap` together (decision 0006). Fixed point, so that one instruction turns a beam by a particle's heading.
struct FieldBeams {
  std::vector<std::uint32_t> ends;         ///< robot frame, x below y, each 16 bits with sign, in 1/16 cells
  std::vector<std::uint32_t> sector_ends;  ///< of each sector: index behind its last beam
  std::uint32_t cap = 1U << 30U;

  /// @pre |end| is not longer than the field's reach
  void add(const LikelihoodField::View& field, Point2 end);
  void close_sector() { sector_ends.push_back(static_cast<std::uint32_t>(ends.size())); }
};

/// Particles as kernels take them; positions are clamped to the map. Rounding: a 65536th of a cell in position, 1/4096
/// in the heading's sine, 1/16 of a cell in a beam's end; together less than a tenth of a cell at 600 cells.
struct FieldPoses {
  std::vector<std::int32_t> column, row;     ///< [cells / 65536]
  std::vector<std::uint32_t> along_columns;  ///< cosine below minus sine, each 16 bits with sign, in 1/4096
  std::vector<std::uint32_t> along_rows;     ///< sine below cosine
  void fill(const LikelihoodField::View& field, const ParticleSet& particles);
};

/// costs[i] = sum over sectors of min(cap, sum over its beams of the field's cost at the beam's end seen from particle
/// i), for all particles and the padding: poses.column.size() entries. Sector by sector, so that the part of the field
/// that a sector's beams hit stays in the first cache.
using FieldKernel = void (*)(const LikelihoodField::View& field, const FieldBeams& beams, const FieldPoses& poses,
                             std::uint32_t* costs);

/// The kernels this processor can run, the plain one first, the fastest last. They agree bit for bit: all is whole
/// numbers.
struct NamedFieldKernel {
  std::string name;
  FieldKernel kernel;
};
[[nodiscard]] std::vector<NamedFieldKernel> field_kernels();

}  // namespace docent::localization
