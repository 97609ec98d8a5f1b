#pragma once

#include <deque>
#include <optional>

#include "docent/collision_avoidance/expected_sweeps/sweep_view.h"

namespace docent::collision_avoidance {

struct ParallaxParams {
  double noise = 0.02;        ///< [m] of a reading against another sweep's, and
  double per_metre = 0.005;   ///< [m/m] more with the distance
  double per_slant = 0.3;     ///< of what the reading changes to the next sample: bearings between the samples
  double way_error = 0.02;    ///< [m] of the motion between the sweeps: wheels slip, mounts are not as they are said,
  double way_share = 0.3;     ///< [m/m] and more with the way
  double turn_error = 0.01;   ///< [rad] likewise,
  double turn_share = 0.05;   ///< [rad/rad] and more with the turn
  double joins = 0.1;         ///< [m] two neighbours are of one thing, and
  double joins_steps = 3.0;   ///< times the distance between samples more
  double most_offset = 2.0;   ///< [m] a greater one is something else
  double steepest = 0.5;      ///< [m/m] a reading that changes more with the offset is an edge
  double steepest_way = 4.0;  ///< [m/m] likewise, with the motion
  int least = 24;             ///< samples that are compared; fewer tell nothing
};

/// The offset of a scanner that adds the same to each reading, from two sweeps and the way between them.
struct ParallaxOffset {
  double offset = 0.0;  ///< [m]
  double error = 0.0;   ///< [m] its standard deviation
  double share = 0.0;   ///< of the samples that agree: the rest are people and edges
};

/// Who drives straight on brings a wall ahead nearer by his way, whatever the offset; but what stands aside passes
/// by the faster, the nearer it truly is. Motion and offset are fitted together by Gauss-Newton with robust weights: a
/// quarter of a metre of way tells the offset within some centimetres. A pure turn tells nothing. O(samples).
/// @param now_from_then  by odometry, from the sensor then to the sensor now
/// @returns nullopt where too little is seen in both, or no offset explains it
[[nodiscard]] std::optional<ParallaxOffset> offset_by_parallax(const SweepView& then, const SweepView& now,
                                                               const Pose2& now_from_then,
                                                               const ParallaxParams& params = {});

struct ParallaxCheckParams {
  ParallaxParams pair{};
  double between = 0.01;      ///< [m] of way between sweeps that are kept
  double least_way = 0.2;     ///< [m] between two that are compared,
  double farthest = 0.8;      ///< [m] at most: then other places are in view,
  double most_turn = 0.6;     ///< [rad] likewise,
  double longest = 8.0;       ///< [s] or other people
  double news_turn = 0.1;     ///< [rad] who turns on the spot keeps his newest sweep,
  double news_time = 1.0;     ///< [s] who stands likewise
  double share = 0.3;         ///< of the samples of a pair must agree
  double least_error = 0.03;  ///< [m] of a pair, and of all: things are not where two beams say to the millimetre
  int least_pairs = 3;        ///< that count together,
  int most_pairs = 20;        ///< the last ones
  double same = 0.15;         ///< [m] a pair agrees with all, besides its error,
  double agree = 0.75;        ///< of the weight must
  double most_scatter = 3.0;  ///< of the pairs about their mean, in squares of their errors: people walk by
  double sure = 4.0;          ///< standard deviations
  double least_offset = 0.3;  ///< [m] a smaller one is for walls, the sweep before and the map
  double in_order = 0.12;     ///< [m] at most, of a scanner in order
};

/// Compares sweeps along the way, until the scanner was in order: an offset that begins later shows to the sweep
/// before.
class ParallaxCheck {
 public:
  explicit ParallaxCheck(const ParallaxCheckParams& params = {}) : params_{params} {}

  enum class Finding { nothing, in_order, offset };
  /// One sweep. @returns what is sure; nothing more once the scanner was in order. O(samples)
  Finding add(const SweepView& view);
  [[nodiscard]] double offset() const { return offset_; }  ///< [m] of the last pairs
  /// Nothing that was seen of before counts: the robot was carried off, or odometry is missing.
  void forget_place() {
    trail_.clear();
    pairs_.clear();
  }
  /// The scanner is another one, or is mounted elsewhere.
  void forget() { *this = ParallaxCheck{params_}; }

 private:
  /// Keeps a sweep. @returns whether it was seen from another place
  bool keep(const SweepView& view);
  [[nodiscard]] Finding judge();

  ParallaxCheckParams params_;
  std::deque<SweepView> trail_;
  std::deque<ParallaxOffset> pairs_;
  double offset_ = 0.0;
  bool was_in_order_ = false;
};

}  // namespace docent::collision_avoidance
