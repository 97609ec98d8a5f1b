#include "docent/localization/monte_carlo/scan_proposal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace docent::localization {

namespace {

/// Likelihoods of all headings of the places of a tile.
class TileWeigher {
 public:
  TileWeigher(const StateSpace& space, const RangeTable& table, std::span<const BeamCosts> beams, std::size_t sectors,
              std::uint16_t cap, InstructionSet set)
      : space_{space},
        table_{table},
        headings_{static_cast<std::size_t>(space.headings())},
        blocks_{(headings_ + TileScorer::kBlock - 1) / TileScorer::kBlock},
        scorer_{beams, headings_, sectors, cap, set},
        costs_(RangeTable::kTile * blocks_ * TileScorer::kBlock),
        likelihoods_(headings_) {
    for (std::size_t cost = 0; cost <= std::numeric_limits<std::uint16_t>::max(); ++cost)
      decay_.push_back(static_cast<float>(std::exp(-static_cast<double>(cost) / kCostPerNat)));
  }

  /// @returns how many places the tile has.
  std::size_t score(std::size_t tile) {
    const std::size_t places = std::min(RangeTable::kTile, space_.places() - tile * RangeTable::kTile);
    std::array<std::uint8_t, RangeTable::kTile> lanes{};
    std::array<std::uint16_t*, RangeTable::kTile> rows{};
    for (std::size_t lane = 0; lane < places; ++lane) {
      lanes[lane] = static_cast<std::uint8_t>(lane);
      rows[lane] = costs_.data() + lane * blocks_ * TileScorer::kBlock;
    }
    scorer_.score(table_.tile(tile), (std::uint64_t{1} << blocks_) - 1, std::span{lanes}.first(places),
                  std::span{rows}.first(places));
    return places;
  }
  /// Of a place of the tile that was scored last: the sum of its likelihoods, which stay in likelihoods().
  double weigh(std::size_t lane) {
    const std::uint16_t* const costs = costs_.data() + lane * blocks_ * TileScorer::kBlock;
    double sum = 0.0;
    for (std::size_t h = 0; h < headings_; ++h) {
      likelihoods_[h] = decay_[costs[h]];
      sum += static_cast<double>(likelihoods_[h]);
    }
    return sum;
  }
  [[nodiscard]] std::span<const float> likelihoods() const { return likelihoods_; }

 private:
  const StateSpace& space_;
  const RangeTable& table_;
  std::size_t headings_;
  std::size_t blocks_;
  TileScorer scorer_;
  std::vector<float> decay_;
  std::vector<std::uint16_t> costs_;  ///< [kTile][blocks][kBlock]
  std::vector<float> likelihoods_;
};

}  // namespace

ScanProposal draw_from_scan(const StateSpace& space, const RangeTable& table, std::span<const BeamCosts> beams,
                            std::size_t sectors, std::uint16_t cap, std::size_t count, const TileChoice& tiles,
                            InstructionSet set, Rng& rng) {
  TileWeigher weigher{space, table, beams, sectors, cap, set};
  const std::size_t all_tiles = (space.places() + RangeTable::kTile - 1) / RangeTable::kTile;
  std::vector<float> sums;  // of the places that are weighed
  double total = 0.0;
  for (std::size_t tile = tiles.first; tile < all_tiles; tile += tiles.stride) {
    const std::size_t places = weigher.score(tile);
    for (std::size_t lane = 0; lane < places; ++lane) {
      sums.push_back(static_cast<float>(weigher.weigh(lane)));
      total += static_cast<double>(sums.back());
    }
  }
  ScanProposal proposal;
  if (sums.empty() || !(total > 0.0)) return proposal;
  proposal.mean_likelihood = total / (static_cast<double>(sums.size()) * space.headings());
  proposal.poses.resize(count);
  proposal.likelihood.resize(count);
  // Draws are even steps through all states in a row; a tile that nothing is drawn from is not scored a second time.
  const double step = total / static_cast<double>(count);
  double target = step * rng.uniform();
  double before = 0.0;
  std::size_t drawn = 0;
  std::size_t scored = all_tiles;
  for (std::size_t k = 0; k < sums.size() && drawn < count; ++k) {
    const double after = before + static_cast<double>(sums[k]);
    if (target < after) {
      const std::size_t tile = tiles.first + k / RangeTable::kTile * tiles.stride;
      const std::size_t lane = k % RangeTable::kTile;
      if (scored != tile) weigher.score(scored = tile);
      weigher.weigh(lane);
      const std::size_t place = tile * RangeTable::kTile + lane;
      const auto likelihoods = weigher.likelihoods();
      double passed = before;
      std::size_t h = 0;
      for (; drawn < count && target < after; target += step, ++drawn) {
        while (h + 1 < likelihoods.size() && passed + static_cast<double>(likelihoods[h]) <= target)
          passed += static_cast<double>(likelihoods[h++]);
        const double half = 0.5 * space.frame().resolution;
        const Point2 at = space.centre(place) + Point2{rng.uniform(-half, half), rng.uniform(-half, half)};
        const double heading = (static_cast<double>(h) + rng.uniform(-0.5, 0.5)) * space.heading_step();
        proposal.poses.set(drawn, {at.x, at.y, Angle::radians(heading)}, 1.0F);
        proposal.likelihood[drawn] = likelihoods[h];
      }
    }
    before = after;
  }
  proposal.poses.resize(drawn);
  proposal.likelihood.resize(drawn);
  return proposal;
}

}  // namespace docent::localization
