#pragma once

#include <optional>
#include <span>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct WallShapeParams {
  double window = 1.4;        ///< [rad] of the field that are looked at together: a narrower piece hardly bends
  double step = 0.2;          ///< [rad] between such windows
  double between = 0.2;       ///< [s] between looks
  double noise = 0.025;       ///< [m] standard deviation of a reading
  double outlier = 3.0;       ///< of these a sample that is off counts at most: somebody stands before the wall
  double on_wall = 0.8;       ///< of a window's samples lie on its line at least
  double better = 1.0;        ///< a sample, by which one explanation's squared error is less, in noises
  double least_offset = 0.2;  ///< [m] less hardly bends a wall
  double same = 0.15;         ///< [m] between two looks at one offset
  int windows = 3;            ///< in one look, or of several, that tell of an offset
  int looks = 4;              ///< in which they were seen
  double one_sided = 4.0;     ///< times as many windows as tell of the contrary
  double memory = 6.0;        ///< [s] of looks
};

/// Whether walls are straight: with an offset in all ranges a wall that fills much of the field is bent, whatever the
/// place (a conchoid), and straight again without it. Needs neither a map nor a sweep before; a wall that is round is
/// straight by no offset.
class WallShape {
 public:
  explicit WallShape(const WallShapeParams& params = {}) : params_{params} {}

  enum class Finding { nothing, straight, bent };
  /// One sweep. O(samples * offsets) a look
  Finding add(const SweepView& view);
  [[nodiscard]] double offset() const { return offset_; }  ///< [m] of the last `bent`: so much too long
  void forget() { looks_.clear(); }

 private:
  struct Look {
    Time stamp;
    std::vector<double> bent;  ///< [m] of each window that an offset straightens
    int straight = 0;          ///< windows that are straight as they are, and by no offset
  };
  [[nodiscard]] Look look(const SweepView& view) const;
  void judge_window(const SweepView& view, std::size_t first, std::size_t count, Look& found) const;
  /// The squared error, in noises, a sample, of the best line through a window's samples less `offset`; nullopt: no
  /// wall.
  [[nodiscard]] std::optional<double> error_of(std::span<const float> ranges, double first_bearing, double bearing_step,
                                               double offset) const;

  WallShapeParams params_;
  std::vector<Look> looks_;
  double offset_ = 0.0;
};

}  // namespace docent::collision_avoidance
