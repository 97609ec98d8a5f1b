#include "docent/localization/particles/particle_weights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace docent::localization {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// exp(-min(rate * above, most)) for all whole numbers, as a table up to where it is constant or nothing more.
class Decay {
 public:
  Decay(double rate, double most, std::uint32_t largest) {
    const double end = rate > 0.0 ? std::ceil(most / rate) : 0.0;
    const auto last = static_cast<std::uint32_t>(std::min(end, static_cast<double>(largest)));
    for (std::uint32_t above = 0; above <= last; ++above)
      factors_.push_back(static_cast<float>(std::exp(-std::min(rate * above, most))));
  }
  [[nodiscard]] float operator()(std::uint32_t above) const {
    return factors_[std::min<std::size_t>(above, factors_.size() - 1)];
  }

 private:
  std::vector<float> factors_;
};

/// 1 for the particles inside.
std::vector<std::uint8_t> inside(const ParticleSet& particles, const Neighbourhood& neighbourhood) {
  std::vector<std::uint8_t> result(particles.size(), 0);
  const auto x = static_cast<float>(neighbourhood.about.x);
  const auto y = static_cast<float>(neighbourhood.about.y);
  const Point2 heading = unit(neighbourhood.about.theta);
  const auto hx = static_cast<float>(heading.x);
  const auto hy = static_cast<float>(heading.y);
  const auto reach = static_cast<float>(neighbourhood.radius * neighbourhood.radius);
  const auto least_cosine = static_cast<float>(std::cos(std::min(neighbourhood.turn, std::numbers::pi)));
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const float dx = particles.x[i] - x;
    const float dy = particles.y[i] - y;
    const bool is_there = dx * dx + dy * dy <= reach;
    const bool looks_there = particles.heading_x[i] * hx + particles.heading_y[i] * hy >= least_cosine;
    result[i] = is_there && looks_there ? 1 : 0;
  }
  return result;
}

}  // namespace

double mean_likelihood(const ParticleSet& particles, std::span<const std::uint32_t> costs, double nats_per_cost) {
  double sum = 0.0;
  double mass = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto weight = static_cast<double>(particles.weight[i]);
    sum += weight * std::exp(-nats_per_cost * costs[i]);
    mass += weight;
  }
  return mass > 0.0 ? sum / mass : 0.0;
}

double reweigh(ParticleSet& particles, std::span<const std::uint32_t> costs, const ParticleEvidence& evidence) {
  const std::size_t count = particles.size();
  const std::vector<std::uint8_t> is_near =
      evidence.focus ? inside(particles, *evidence.focus) : std::vector<std::uint8_t>(count, 0);
  std::uint32_t best = kNone;
  std::uint32_t best_near = kNone;
  std::uint32_t worst = 0;
  double mass = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!(particles.weight[i] > 0.0F)) continue;
    best = std::min(best, costs[i]);
    if (is_near[i] != 0) best_near = std::min(best_near, costs[i]);
    worst = std::max(worst, costs[i]);
    mass += static_cast<double>(particles.weight[i]);
  }
  if (!(mass > 0.0)) return 0.0;
  const std::uint32_t span = worst - best;
  const Decay whole{evidence.nats_per_cost, 700.0, span};
  const Decay sharp{evidence.nats_per_cost, evidence.most_nats, span};
  const double far_share = evidence.focus ? evidence.far_share : 1.0;
  const Decay slow{evidence.nats_per_cost * far_share, evidence.focus ? evidence.far_most_nats : evidence.most_nats,
                   span};
  double likelihood = 0.0;
  double slow_mass = 0.0;   // of the focus, by the far evidence
  double sharp_mass = 0.0;  // and by all
  for (std::size_t i = 0; i < count; ++i) {
    const float weight = particles.weight[i];
    if (!(weight > 0.0F)) continue;
    likelihood += static_cast<double>(weight * whole(costs[i] - best));
    if (is_near[i] == 0) continue;
    slow_mass += static_cast<double>(weight * slow(costs[i] - best));
    sharp_mass += static_cast<double>(weight * sharp(costs[i] - best_near));
  }
  const auto scale = static_cast<float>(sharp_mass > 0.0 ? slow_mass / sharp_mass : 0.0);
  double total = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    float& weight = particles.weight[i];
    if (!(weight > 0.0F)) continue;
    weight *= is_near[i] != 0 ? scale * sharp(costs[i] - best_near) : slow(costs[i] - best);
    total += static_cast<double>(weight);
  }
  const auto normalise = static_cast<float>(1.0 / total);
  for (float& weight : particles.weight) weight *= normalise;
  return likelihood / mass * std::exp(-evidence.nats_per_cost * best);
}

void gather(ParticleSet& particles, const Gathering& gathering) {
  const std::vector<std::uint8_t> is_near = inside(particles, gathering.all);
  const std::vector<std::uint8_t> is_found = inside(particles, gathering.found);
  double found = 0.0;
  double rest = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (is_near[i] != 0) (is_found[i] != 0 ? found : rest) += static_cast<double>(particles.weight[i]);
  const Gathering::Factors factors = gathering.factors(found, rest);
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (is_near[i] != 0) particles.weight[i] *= static_cast<float>(is_found[i] != 0 ? factors.found : factors.rest);
}

}  // namespace docent::localization
