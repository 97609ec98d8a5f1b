#pragma once

#include <optional>
#include <vector>

#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct StraightWallsParams {
  double noise = 0.015;         ///< [m] of a reading at least, and
  double per_metre = 0.003;     ///< [m/m] more with the distance
  double per_slant = 0.15;      ///< of what the reading changes to the next sample: bearings between the samples
  double off = 0.05;            ///< [m] a sample of a piece may be off it, and
  double off_per_metre = 0.01;  ///< [m/m] more with the distance
  int least_samples = 10;       ///< of a piece
  double least_angle = 0.45;    ///< [rad] 26 degrees, which a piece takes of the field: a narrower one hardly bends
  double least_length = 1.0;    ///< [m] wider than a person
  double most_offset = 2.0;     ///< [m] a piece that wants a greater one is round
  double tells = 0.1;           ///< [m] a piece whose own offset is less certain tells nothing
  double agrees = 0.12;         ///< [m] between the offset of a piece and that of all
  double share = 0.8;     ///< of the samples of all pieces must agree: then walls are straight, and the ranges wrong
  int least_pieces = 2;   ///< that look in other directions,
  double other = 0.5;     ///< [rad] by so much: one that is bent is a bent wall
  int least_of_all = 30;  ///< samples of all pieces
  double least_offset = 0.25;  ///< [m] a smaller one is for the sweep before and the map: walls of recorded buildings
                               ///< bent by 0.2 m
  double in_order = 0.12;      ///< [m] at most, of a scanner in order
  double sure = 8.0;           ///< standard deviations
  int many_pieces = 3;         ///< at once do; two may be bent alike,
  double elsewhere = 0.25;     ///< [m] and must be seen to be so from another place,
  double same = 0.15;          ///< [m] by the same offset
  int sweeps = 2;              ///< that say so, at least
  double far_elsewhere = 1.5;  ///< [m] as elsewhere, of a scanner that was in order: offsets that begin show otherwise,
  int more_sweeps = 5;         ///< and so many
};

/// What the walls of one sweep say of its ranges.
struct StraightWalls {
  int pieces = 0;       ///< that tell anything
  int samples = 0;      ///< of them
  double offset = 0.0;  ///< [m] by which the ranges are too long, for the pieces to be straight
  double error = 0.0;   ///< [m] its standard deviation
  bool agree = false;   ///< the pieces want one offset, and look in different directions
};

/// The offset of a scanner that adds the same to each reading, from one sweep and without any map: a straight wall at
/// the distance d then reads d / cos(bearing) + offset, which is no straight line. A factor leaves walls straight. Each
/// piece is fitted by Gauss-Newton; pieces are found by halving where a wall with an offset does not fit. nullopt: too
/// few long walls are seen. O(samples * log samples), mostly.
[[nodiscard]] std::optional<StraightWalls> straight_walls_of(const SweepView& view,
                                                             const StraightWallsParams& params = {});

/// Judges sweep after sweep, as the walls of single ones are no proof: a bent wall is bent from wherever it is seen,
/// but by the same offset from one place alone.
class StraightWallsCheck {
 public:
  explicit StraightWallsCheck(const StraightWallsParams& params = {}) : params_{params} {}

  enum class Finding { nothing, in_order, offset };
  /// One sweep. O(samples * log samples), mostly. @returns `offset` once it is sure, and with each sweep that says so
  Finding add(const SweepView& view);
  [[nodiscard]] double offset() const { return offset_; }  ///< [m] of the last `offset`
  /// The scanner is another one, or is mounted elsewhere.
  void forget() { *this = StraightWallsCheck{params_}; }

 private:
  struct Seen {
    Point2 in_odom;
    double offset;
  };
  StraightWallsParams params_;
  std::vector<Seen> seen_;  ///< sweeps that wanted an offset, since one was in order
  bool was_in_order_ = false;
  double offset_ = 0.0;
};

}  // namespace docent::collision_avoidance
