#include "docent/localization/monte_carlo/scan_proposal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace docent {

namespace {

constexpr std::size_t kBlock = 64;  // headings a kernel takes at a time

/// Likelihoods of all headings of a place.
class PlaceScorer {
 public:
  PlaceScorer(const StateSpace& space, const RangeTable& table, std::span<const BeamCosts> beams, std::size_t sectors,
              std::uint16_t cap, ScoreKernel kernel)
      : table_{table},
        headings_{static_cast<std::size_t>(space.headings())},
        cap_{cap},
        kernel_{kernel},
        costs_((headings_ + kBlock - 1) / kBlock * kBlock),
        likelihoods_(headings_) {
    for (std::size_t first = 0; first < beams.size();) {
      const auto sector = [&](std::size_t i) { return beams[i].direction * sectors / headings_; };
      std::size_t last = first + 1;
      while (last < beams.size() && sector(last) == sector(first)) ++last;
      sectors_.push_back(beams.subspan(first, last - first));
      first = last;
    }
    for (std::size_t cost = 0; cost <= std::numeric_limits<std::uint16_t>::max(); ++cost)
      decay_.push_back(static_cast<float>(std::exp(-static_cast<double>(cost) / kCostPerNat)));
  }

  /// Their sum; they stay in likelihoods().
  double weigh(std::size_t place) {
    for (std::size_t first = 0; first < headings_; first += kBlock) {
      const std::size_t count = std::min(kBlock, headings_ - first);
      std::uint16_t* const costs = costs_.data() + first;
      std::fill_n(costs, kBlock, std::uint16_t{0});
      for (const auto& sector : sectors_) {
        kernel_(table_.row(place), first, count, sector, part_.data());
        for (std::size_t i = 0; i < kBlock; ++i)
          costs[i] = static_cast<std::uint16_t>(costs[i] + std::min(part_[i], cap_));
      }
    }
    double sum = 0.0;
    for (std::size_t h = 0; h < headings_; ++h) {
      likelihoods_[h] = decay_[costs_[h]];
      sum += static_cast<double>(likelihoods_[h]);
    }
    return sum;
  }
  [[nodiscard]] std::span<const float> likelihoods() const { return likelihoods_; }

 private:
  const RangeTable& table_;
  std::size_t headings_;
  std::uint16_t cap_;
  ScoreKernel kernel_;
  std::vector<std::span<const BeamCosts>> sectors_;
  std::vector<float> decay_;
  std::vector<std::uint16_t> costs_;
  std::vector<float> likelihoods_;
  std::array<std::uint16_t, kBlock> part_{};
};

}  // namespace

ScanProposal draw_from_scan(const StateSpace& space, const RangeTable& table, std::span<const BeamCosts> beams,
                            std::size_t sectors, std::uint16_t cap, std::size_t count, const PlaceChoice& places,
                            ScoreKernel kernel, Rng& rng) {
  PlaceScorer scorer{space, table, beams, sectors, cap, kernel};
  std::vector<float> sums;  // of the places that are weighed
  double total = 0.0;
  for (std::size_t place = places.first; place < space.places(); place += places.stride) {
    sums.push_back(static_cast<float>(scorer.weigh(place)));
    total += static_cast<double>(sums.back());
  }
  ScanProposal proposal;
  if (sums.empty() || !(total > 0.0)) return proposal;
  proposal.mean_likelihood = total / (static_cast<double>(sums.size()) * space.headings());
  proposal.poses.resize(count);
  proposal.likelihood.resize(count);
  // Draws are even steps through all states in a row; what lies between two places that are drawn from is not weighed
  // a second time.
  const double step = total / static_cast<double>(count);
  double target = step * rng.uniform();
  double before = 0.0;
  std::size_t drawn = 0;
  for (std::size_t k = 0; k < sums.size() && drawn < count; ++k) {
    const double after = before + static_cast<double>(sums[k]);
    if (target < after) {
      const std::size_t place = places.first + k * places.stride;
      scorer.weigh(place);
      const auto likelihoods = scorer.likelihoods();
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

}  // namespace docent
