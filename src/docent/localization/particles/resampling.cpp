#include "docent/localization/particles/resampling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "docent/base/check.h"

namespace docent::localization {

namespace {

/// Draws by `draw(i)`, whose sum is `total`; each copy of particle i weighs `weigh(i)`.
template <class Draw, class Weigh>
void draw_systematically(const ParticleSet& from, std::size_t first, std::size_t last, std::size_t count, double offset,
                         double total, const Draw& draw, const Weigh& weigh, ParticleSet& to) {
  DOCENT_CHECK(total > 0.0);
  std::size_t next = to.size();
  const std::size_t end = next + count;
  const double draws_per_mass = static_cast<double>(count) / total;
  // Draw k hits where the mass so far passes k + 1 - offset.
  double passed = offset + static_cast<double>(next);
  to.resize(end);
  const auto copy_until = [&](std::size_t i, std::size_t until) {
    if (next >= until) return;
    const float weight = weigh(i);
    for (; next < until; ++next) {
      to.x[next] = from.x[i];
      to.y[next] = from.y[i];
      to.heading_x[next] = from.heading_x[i];
      to.heading_y[next] = from.heading_y[i];
      to.weight[next] = weight;
    }
  };
  for (std::size_t i = first; i < last; ++i) {
    passed += draw(i) * draws_per_mass;
    copy_until(i, std::min(static_cast<std::size_t>(passed), end));
  }
  // Rounding may leave the last draw over; it goes to the last particle that weighs anything.
  std::size_t heir = last - 1;
  while (heir > first && !(from.weight[heir] > 0.0F)) --heir;
  copy_until(heir, end);
}

}  // namespace

void resample(const ParticleSet& from, std::size_t first, std::size_t last, std::size_t count, double offset,
              ParticleSet& to) {
  const double mass = from.mass(first, last);
  const auto weight = static_cast<float>(mass / static_cast<double>(count));
  draw_systematically(
      from, first, last, count, offset, mass, [&](std::size_t i) { return static_cast<double>(from.weight[i]); },
      [weight](std::size_t) { return weight; }, to);
}

void resample_flattened(const ParticleSet& from, std::size_t first, std::size_t last, std::size_t count, double offset,
                        ParticleSet& to) {
  double total = 0.0;
  const auto root = [&](std::size_t i) { return std::sqrt(static_cast<double>(from.weight[i])); };
  for (std::size_t i = first; i < last; ++i) total += root(i);
  // w / expected number of copies
  const double scale = total / static_cast<double>(count);
  const std::size_t begin = to.size();
  draw_systematically(
      from, first, last, count, offset, total, root, [&](std::size_t i) { return static_cast<float>(root(i) * scale); },
      to);
  const double mass = from.mass(first, last);
  const auto back = static_cast<float>(mass / to.mass(begin, to.size()));
  for (std::size_t i = begin; i < to.size(); ++i) to.weight[i] *= back;
}

double effective_size(const ParticleSet& particles, std::size_t first, std::size_t last) {
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    const auto weight = static_cast<double>(particles.weight[i]);
    sum += weight;
    squares += weight * weight;
  }
  return squares > 0.0 ? sum * sum / squares : 0.0;
}

Result<void> KldParams::validate() const {
  if (!(cell_size > 0.0)) return fail("kld.cell_size must be > 0");
  if (!(heading_step > 0.0 && heading_step <= 360.0)) return fail("kld.heading_step must be > 0 and <= 360");
  if (!(error > 0.0)) return fail("kld.error must be > 0");
  if (!(quantile >= 0.0 && quantile <= 5.0)) return fail("kld.quantile must be 0..5");
  return {};
}

std::size_t kld_sample_size(std::size_t bins, const KldParams& params) {
  if (bins < 2) return 1;
  const double k = static_cast<double>(bins) - 1.0;
  const double spread = 2.0 / (9.0 * k);
  const double root = 1.0 - spread + std::sqrt(spread) * params.quantile;
  return static_cast<std::size_t>(std::ceil(k / (2.0 * params.error) * root * root * root));
}

std::size_t occupied_bins(const ParticleSet& particles, std::size_t first, std::size_t last, const KldParams& params) {
  const double mass = particles.mass(first, last);
  if (last <= first || !(mass > 0.0)) return 0;
  std::vector<std::pair<std::uint64_t, float>> entries;
  entries.reserve(last - first);
  const double headings_per_radian = 180.0 / std::numbers::pi / params.heading_step;
  const auto part = [](double value) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(value) + 0x80000); };
  for (std::size_t i = first; i < last; ++i) {
    if (!(particles.weight[i] > 0.0F)) continue;
    const Pose2 pose = particles.pose(i);
    const std::uint64_t key = (part(std::floor(pose.x / params.cell_size)) << 42U) |
                              (part(std::floor(pose.y / params.cell_size)) << 21U) |
                              part(std::floor(pose.theta.radians() * headings_per_radian));
    entries.emplace_back(key, particles.weight[i]);
  }
  std::sort(entries.begin(), entries.end());
  const double enough = 0.5 * mass / static_cast<double>(last - first);
  std::size_t bins = 0;
  for (std::size_t i = 0; i < entries.size();) {
    double sum = 0.0;
    const std::uint64_t key = entries[i].first;
    for (; i < entries.size() && entries[i].first == key; ++i) sum += static_cast<double>(entries[i].second);
    bins += sum >= enough ? 1 : 0;
  }
  return bins;
}

}  // namespace docent::localization
