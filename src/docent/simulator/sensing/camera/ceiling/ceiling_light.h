#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "docent/simulator/sensing/camera/ceiling/ceiling.h"

namespace docent::simulator {

/// How bright it is over the floor, on a grid: what each circuit and the daylight bring, of which a moment's light is
/// the sum. Light spreads from lamps as a bell, without walls.
class CeilingLight {
 public:
  CeilingLight() = default;
  /// Over the rectangle from `low` to `high`. O(cells near lamps).
  CeilingLight(const Ceiling& ceiling, Point2 low, Point2 high);

  /// A moment's light.
  class Field {
   public:
    /// At a place: 0.8 is usual with all lamps on by day.
    [[nodiscard]] float at(float x, float y) const { return sample(now_, x, y); }
    /// As a share of what it is with all lamps on by day.
    [[nodiscard]] float share_at(float x, float y) const {
      return is_usual_ ? 1.0F : sample(now_, x, y) / std::max(1e-3F, sample(*usual_, x, y));
    }
    [[nodiscard]] const Lighting& lighting() const { return lighting_; }

   private:
    friend class CeilingLight;
    [[nodiscard]] float sample(const std::vector<float>& cells, float x, float y) const;
    float x_ = 0.0F, y_ = 0.0F;
    int columns_ = 0, rows_ = 0;
    bool is_usual_ = true;
    std::vector<float> now_;
    const std::vector<float>* usual_ = nullptr;
    Lighting lighting_;
  };
  /// O(cells). It refers to this.
  [[nodiscard]] Field field(const Lighting& lighting) const;

 private:
  void add_bell(std::vector<float>& cells, Point2 at, double reach, double peak) const;

  Point2 low_;
  int columns_ = 0, rows_ = 0;
  std::vector<float> day_;                                  ///< [rows][columns]
  std::array<std::vector<float>, kLampCircuits> circuits_;  ///< likewise
  std::vector<float> usual_;                                ///< their sum
};

}  // namespace docent::simulator
