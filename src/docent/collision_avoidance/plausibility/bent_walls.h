#pragma once

#include <deque>
#include <optional>
#include <span>

#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct BentWallsParams {
  double between = 0.19;         ///< [s] between sweeps that are looked at
  double window = 0.96;          ///< [rad] 55 degrees of a sweep, in which a wall shows its offset to 6 cm
  double step = 0.24;            ///< [rad] between such windows
  double holes = 0.2;            ///< of a window's samples lie off the wall at most: people before it
  double off = 0.06;             ///< [m] so far off
  double noise = 0.02;           ///< [m] root mean square of the others at most,
  double per_metre = 0.003;      ///< [m/m] and more with the distance
  double slant = 3.0;            ///< times as far as the nearest of a window the farthest is: more grazes the wall
  double least = -0.8;           ///< [m] offsets that are tried,
  double most = 2.0;             ///< [m]
  double grid = 0.1;             ///< [m]
  double sure_offset = 0.1;      ///< [m] standard deviation of a window's offset at most
  double straight = 0.12;        ///< [m] smaller offsets are none
  double bent = 0.2;             ///< [m] greater ones are some,
  double sigmas = 4.0;           ///< and so many standard deviations
  double same = 0.1;             ///< [m] between offsets that are one
  double memory = 15.0;          ///< [s] of windows that count
  std::size_t votes = 10;        ///< sweeps that say the same
  double than_others = 5.0;      ///< times as many as say that walls are straight,
  double share = 0.6;            ///< and of all that say anything
  double other_wall = 0.7;       ///< [rad] between two of the walls: one may be round
  double newest = 3.0;           ///< [s] in which, afterwards, walls are straight again:
  std::size_t straight_again = 5;  ///< sweeps
};

/// Finds an offset in all ranges by the walls: at distance d one reads d / cos(bearing - normal) + offset, which is
/// straight for no offset but 0. It shows at rest, in one sweep, and whatever the place; what is bent by itself, a round
/// wall or a row of people, is bent by another offset from elsewhere, and so are two walls.
class BentWalls {
 public:
  explicit BentWalls(const BentWallsParams& params = {}) : params_{params} {}

  /// One sweep. O(windows * offsets * samples of a window). @returns [m] the offset that bends the walls
  std::optional<double> add(const SweepView& view);
  /// The walls of the last seconds are straight.
  [[nodiscard]] bool are_straight() const;
  void forget() { votes_.clear(); }

 private:
  struct Sample {
    double cosine = 1.0;
    double sine = 0.0;
    double range = 0.0;  ///< [m]
  };
  struct Wall {
    double offset = 0.0;  ///< [m]
    double sigma = 0.0;   ///< [m]
    double normal = 0.0;  ///< [rad], sensor frame
  };
  struct Vote {
    Time stamp;
    double offset = 0.0;
    Angle normal;  ///< odometry's frame
    bool is_bent = false;
  };
  /// Of a line that reads `offset` more: its residuals' sum of squares and count.
  struct Line {
    double squares = 0.0;
    double normal = 0.0;
    int count = 0;
  };
  [[nodiscard]] Line line_of(std::span<const Sample> samples, double offset) const;
  [[nodiscard]] std::optional<Wall> wall_of(std::span<const Sample> samples) const;
  void look(const SweepView& view);
  [[nodiscard]] std::optional<double> offset() const;

  BentWallsParams params_;
  Time looked_{};
  std::deque<Vote> votes_;  ///< one a sweep
};

}  // namespace docent::collision_avoidance
