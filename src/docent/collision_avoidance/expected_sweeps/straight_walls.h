#pragma once

#include <array>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct StraightWallsParams {
  double noise = 0.015;         ///< [m] of a reading at least, and
  double per_metre = 0.003;     ///< [m/m] more with the distance
  double per_slant = 0.15;      ///< of what the reading changes to the next sample: bearings between the samples
  double off = 0.05;            ///< [m] a sample of a piece may be off it, and
  double off_per_metre = 0.01;  ///< [m/m] more with the distance
  int least_samples = 8;        ///< of a piece
  double least_angle = 0.26;    ///< [rad] 15 degrees, which a piece takes of the field: a narrower one hardly bends
  double least_length = 0.8;    ///< [m] wider than a person
  double most_offset = 2.0;     ///< [m] a piece that wants a greater one is round
  double tells = 0.5;           ///< [m] a piece whose own offset is less certain tells nothing
};

/// A straight piece of what one sweep sees.
struct WallPiece {
  double bearing = 0.0;  ///< [rad] of its foot, sensor frame
  double offset = 0.0;   ///< [m] by which the ranges are too long, for it to be straight
  double error = 0.0;    ///< [m] its standard deviation
  int samples = 0;
};

/// The offset of a scanner that adds the same to each reading, from one sweep and without any map: a straight wall at
/// the distance d then reads d / cos(bearing) + offset, which is no straight line. A factor leaves walls straight. Each
/// piece is fitted by Gauss-Newton; pieces are found by halving where a wall with an offset does not fit.
/// O(samples * log samples), mostly.
[[nodiscard]] std::vector<WallPiece> straight_walls_of(const SweepView& view, const StraightWallsParams& params = {});

struct StraightWallsCheckParams {
  StraightWallsParams walls{};
  double news_way = 0.1;       ///< [m] after which a sweep is news: from one place a bent wall is bent again and again
  double news_turn = 0.1;      ///< [rad] likewise,
  double news_time = 2.0;      ///< [s] or this: a scanner may have been mended
  double remembers = 0.03;     ///< [m] what was seen counts as if it were no surer: what comes then takes its place
  double longest = 6.0;        ///< [m] of way, then what was seen is forgotten by half
  double least_error = 0.05;   ///< [m] of all walls of one direction: real ones are not straight
  double counts = 0.15;        ///< [m] a direction whose offset is less certain does not count yet
  int least_directions = 2;    ///< one wall may be bent
  double agrees = 0.12;        ///< [m] between the offset of a direction and that of all, besides errors
  double share = 0.8;          ///< of the weight must agree
  double sure = 5.0;           ///< standard deviations
  double in_order = 0.12;      ///< [m] at most, of a scanner in order
  double least_offset = 0.25;  ///< [m] a smaller one is for the sweep before and the map
  double elsewhere = 0.5;      ///< [m] of way, by which walls must be seen from other places
};

/// Gathers what straight pieces say, by the directions of the walls: where a robot goes it sees few that are long, and
/// many that are cut into pieces by people and things. A scanner that was in order is not blamed by them any more:
/// offsets that begin later show to the sweep before and to the map, and some corner of a building always looks bent.
class StraightWallsCheck {
 public:
  explicit StraightWallsCheck(const StraightWallsCheckParams& params = {}) : params_{params} {}

  enum class Finding { nothing, in_order, offset };
  /// One sweep. O(samples * log samples), mostly. @returns `offset` once it is sure, and
  /// with all that comes then; `in_order` from the first time on, in O(1)
  Finding add(const SweepView& view);
  [[nodiscard]] double offset() const { return offset_; }  ///< [m] of all walls
  /// The scanner is another one, or is mounted elsewhere.
  void forget() { *this = StraightWallsCheck{params_}; }

 private:
  struct Direction {
    double weight = 0.0;  ///< [1/m^2]
    double sum = 0.0;     ///< [1/m]
  };
  static constexpr std::size_t kDirections = 12;
  void gather(const SweepView& view);
  [[nodiscard]] Finding judge();

  StraightWallsCheckParams params_;
  std::array<Direction, kDirections> directions_{};
  Pose2 last_;  ///< odom_from_sensor of the last news
  Time last_stamp_{};
  bool has_last_ = false;
  double way_ = 0.0;        ///< [m] since the first news
  double fresh_way_ = 0.0;  ///< [m] since something was forgotten
  bool was_in_order_ = false;
  double offset_ = 0.0;
};

}  // namespace docent::collision_avoidance
