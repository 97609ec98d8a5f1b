#include "docent/localization/monte_carlo/likelihood_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace docent::localization {

namespace {
// What the 16 bits of FieldPoses and FieldBeams hold.
constexpr int kMostCells = 32767;
constexpr int kMostReach = 2047;
}  // namespace

Result<void> LikelihoodFieldParams::validate() const {
  if (!(sigma > 0.0)) return fail("field.sigma must be > 0");
  if (!(near_scale > 0.0)) return fail("field.near_scale must be > 0");
  for (const double weight : {weight_hit, weight_near})
    if (!(weight >= 0.0)) return fail("field.weight_hit and weight_near must be >= 0");
  if (!(weight_random > 0.0)) return fail("field.weight_random must be > 0: no reading is impossible");
  return {};
}

LikelihoodField::LikelihoodField(const sensor_models::RayCaster& caster, const LikelihoodFieldParams& params,
                                 double reach)
    : reach_{reach} {
  const GridFrame& map = caster.frame();
  GridFrame inner = map;
  margin_ = static_cast<int>(std::ceil(reach / inner.resolution)) + 2;
  while (std::max(inner.columns, inner.rows) + 2 * margin_ > kMostCells || margin_ > kMostReach) {
    inner = {(inner.columns + 1) / 2, (inner.rows + 1) / 2, 2.0 * inner.resolution, map.origin};
    margin_ = static_cast<int>(std::ceil(reach / inner.resolution)) + 2;
  }
  const double margin = margin_ * inner.resolution;
  frame_ = {inner.columns + 2 * margin_, inner.rows + 2 * margin_, inner.resolution,
            map.origin - Point2{margin, margin}};
  const auto density = [&](double d) {
    const double z = d / params.sigma;
    return params.weight_hit * std::exp(-0.5 * z * z) / (params.sigma * std::sqrt(2.0 * std::numbers::pi)) +
           params.weight_near * std::exp(-d / params.near_scale) / (2.0 * params.near_scale) +
           params.weight_random / reach;
  };
  const double best = density(0.0);
  const auto cost_at = [&](double d) {
    const double nats = std::isfinite(d) ? std::log(best / density(d)) : std::log(best * reach / params.weight_random);
    return static_cast<std::uint8_t>(std::min<long>(255, std::lround(nats * kScorePerNat)));
  };
  costs_.assign(frame_.size(), cost_at(std::numeric_limits<double>::infinity()));
  for (int row = 0; row < inner.rows; ++row)
    for (int column = 0; column < inner.columns; ++column)
      costs_[frame_.index({column + margin_, row + margin_})] =
          cost_at(static_cast<double>(caster.clearance(inner.centre({column, row}))));
}

LikelihoodField::View LikelihoodField::view() const {
  const double scale = 1.0 / frame_.resolution;
  const auto first = static_cast<float>(margin_);
  return {costs_.data(),
          frame_.columns,
          static_cast<float>(scale),
          static_cast<float>(-frame_.origin.x * scale),
          static_cast<float>(-frame_.origin.y * scale),
          first,
          static_cast<float>(frame_.columns - margin_ - 1),
          first,
          static_cast<float>(frame_.rows - margin_ - 1)};
}

std::uint8_t LikelihoodField::cost(Point2 in_map) const {
  const CellIndex cell = frame_.cell_at(in_map);
  return frame_.holds(cell) ? costs_[frame_.index(cell)] : std::uint8_t{255};
}

}  // namespace docent::localization
