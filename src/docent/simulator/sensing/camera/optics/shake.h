#pragma once

#include <array>
#include <cstdint>

#include "docent/simulator/sensing/camera/optics/viewpoint.h"

namespace docent::simulator {

/// How a base that drives rocks: some oscillations of wheels and mast about each axis, never more than `most`.
class Shake {
 public:
  /// @param most  [rad] about each axis
  Shake(double most, std::uint64_t seed);
  /// @param time  [s]
  [[nodiscard]] Lean at(double time) const;

 private:
  struct Swing {
    double size = 0.0;   ///< [rad]
    double rate = 0.0;   ///< [rad/s]
    double phase = 0.0;  ///< [rad]
  };
  std::array<std::array<Swing, 3>, 2> swings_{};
};

}  // namespace docent::simulator
