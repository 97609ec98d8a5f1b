#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent::localization {

/// Weighted samples of the robot's pose [Minerva2000] 3.3, as arrays: one entry a particle, and behind them as many
/// more, of weight 0, as fill a vector of the widest instruction set. Headings are unit vectors, so that moving and
/// weighing need no trigonometry.
struct ParticleSet {
  static constexpr std::size_t kPadding = 16;

  std::vector<float> x, y;                  ///< [m], map
  std::vector<float> heading_x, heading_y;  ///< cosine and sine of the heading
  std::vector<float> weight;                ///< >= 0

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t padded_size() const { return x.size(); }
  /// New particles stand at the origin, with weight 0.
  void resize(std::size_t count);
  void clear() { resize(0); }
  void set(std::size_t i, const Pose2& map_from_robot, float w);
  /// Entry `to` becomes entry `from` of `others`.
  void copy(const ParticleSet& others, std::size_t from, std::size_t to) {
    x[to] = others.x[from];
    y[to] = others.y[from];
    heading_x[to] = others.heading_x[from];
    heading_y[to] = others.heading_y[from];
    weight[to] = others.weight[from];
  }
  void append(const ParticleSet& others);
  [[nodiscard]] Pose2 pose(std::size_t i) const {
    return {static_cast<double>(x[i]), static_cast<double>(y[i]),
            Angle::radians(std::atan2(static_cast<double>(heading_y[i]), static_cast<double>(heading_x[i])))};
  }
  /// Of the particles first … last - 1, added up in their order.
  [[nodiscard]] double mass(std::size_t first, std::size_t last) const;

 private:
  std::size_t size_ = 0;
};

}  // namespace docent::localization
