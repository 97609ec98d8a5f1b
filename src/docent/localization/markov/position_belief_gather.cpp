#include <algorithm>
#include <vector>

#include "docent/localization/markov/position_belief.h"

namespace docent::localization {

void PositionBelief::gather(const Gathering& gathering) {
  enum class Part : std::uint8_t { elsewhere, rest, found };
  const auto headings = static_cast<std::size_t>(space_->headings());
  const auto part_of = [&](std::size_t index, std::size_t h) {
    const Point2 centre = space_->centre(static_cast<std::size_t>(kept_[index]));
    const Angle heading = Angle::radians(static_cast<double>(h) * space_->heading_step());
    if (!gathering.all.holds(centre) || !gathering.all.holds(heading)) return Part::elsewhere;
    return gathering.found.holds(centre) && gathering.found.holds(heading) ? Part::found : Part::rest;
  };
  double found = 0.0;
  double rest = 0.0;
  std::vector<std::size_t> rows;  // indices into kept_ of the neighbourhood
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (!gathering.all.holds(space_->centre(static_cast<std::size_t>(kept_[i])))) continue;
    rows.push_back(i);
    const Row probabilities = row(i);
    for (std::size_t h = 0; h < headings; ++h) {
      if (!(probabilities[h] > limit_[h])) continue;
      const Part part = part_of(i, h);
      if (part == Part::found) found += static_cast<double>(probabilities[h]);
      if (part == Part::rest) rest += static_cast<double>(probabilities[h]);
    }
  }
  const Gathering::Factors factors = gathering.factors(found, rest);
  if (factors.rest >= 1.0) return;
  RowTotals totals;
  std::vector<float> before(stride_);
  std::size_t next = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    float* const row = rows_.data() + i * stride_;
    kernels_->expand(row, scale(), before.data());
    const bool is_near = next < rows.size() && rows[next] == i;
    if (is_near) ++next;
    for (std::size_t h = 0; h < headings; ++h) {
      double probability = static_cast<double>(before[h]);
      if (is_near && before[h] > limit_[h]) {
        const Part part = part_of(i, h);
        if (part == Part::found) probability *= factors.found;
        if (part == Part::rest) probability *= factors.rest;
      }
      row[h] = static_cast<float>(probability);
      totals.mass += probability;
      totals.peak = std::max(totals.peak, row[h]);
    }
  }
  normalise(totals, 0.0, true);
}

}  // namespace docent::localization
