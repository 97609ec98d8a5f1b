#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "docent/base/result.h"
#include "docent/sensor_models/ray_caster.h"

namespace docent::localization {

/// p(d) of a beam's end that lies d from the nearest obstacle of the map: a Gaussian, a Laplace density for the map's
/// small faults, and a uniform rest for all that the map does not know.
struct LikelihoodFieldParams {
  double sigma = 0.08;         ///< [m], > 0
  double near_scale = 0.25;    ///< [m], > 0
  double weight_hit = 0.5;     ///< >= 0; the weights are normalised
  double weight_near = 0.3;    ///< >= 0
  double weight_random = 0.2;  ///< > 0
  template <class V>
  void visit(V& v) {
    v("sigma", sigma);
    v("near_scale", near_scale);
    v("weight_hit", weight_hit);
    v("weight_near", weight_near);
    v("weight_random", weight_random);
  }
  [[nodiscard]] Result<void> validate() const;
};

/// What a beam costs, [nat] in steps of 1 / kScorePerNat below the best possible. Whole numbers: every instruction set
/// gives the same sum.
inline constexpr double kScorePerNat = 24.0;

/// ln p of a beam's end, for every cell of the map: one byte each, with a margin as wide as the longest beam, so that
/// a robot inside the map needs no check of bounds. Rows and columns are numbered with 15 bits; the field of a map that
/// has more has cells of twice the size, or four times, and so on.
class LikelihoodField {
 public:
  /// `reach` [m]: of the longest beam. O(cells). @pre params are valid, 0 < reach
  LikelihoodField(const sensor_models::RayCaster& caster, const LikelihoodFieldParams& params, double reach);

  /// What kernels need. A point (x, y) [m, map] has the coordinates x * scale + left, y * scale + bottom, whose whole
  /// parts are column and row; particles are kept within first_column … last_column, first_row … last_row.
  struct View {
    const std::uint8_t* costs;  ///< [rows][stride]
    std::int32_t stride;
    float scale, left, bottom;
    float first_column, last_column, first_row, last_row;
  };
  [[nodiscard]] View view() const;
  [[nodiscard]] double reach() const { return reach_; }
  [[nodiscard]] std::uint8_t cost(Point2 in_map) const;  ///< 255 outside

 private:
  GridFrame frame_;  ///< the margin included
  int margin_;       ///< [cells]
  double reach_;
  std::vector<std::uint8_t> costs_;
};

}  // namespace docent::localization
