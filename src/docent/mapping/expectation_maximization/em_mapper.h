#pragma once

#include <functional>
#include <span>
#include <vector>

#include "docent/mapping/expectation_maximization/evidence_map.h"

namespace docent::mapping {

/// One grid of poses, and how often both steps run over it at most.
struct EmLevel {
  PoseCells cells;
  int iterations = 5;
  double independent = 4;  ///< > 0: cells of a place that are worth counting; their errors hang together
};

struct EmMapperParams {
  PlaceParams places;
  std::vector<EmLevel> levels{{{1.0, 36}, 8, 6}, {{0.5, 72}, 5, 8}, {{0.25, 144}, 4, 16}};
  double way_per_metre = 0.003;    ///< [m2/m], > 0: variance of odometry, by the way,
  double way_per_radian = 0.001;   ///< [m2/rad], and by the turn
  double turn_per_metre = 0.0006;  ///< [rad2/m]
  double turn_per_radian = 0.003;  ///< [rad2/rad]
  double least = 1e-4;             ///< 0..1: cells below this share of the best one are dropped
  double window = 3.0;             ///< > 0: on a finer level poses are looked for within so many coarser cells
  double still = 0.15;             ///< [cells]: a level ends when poses move less on average
  template <class V>
  void visit(V& v) {
    v("places", places);
    v("way_per_metre", way_per_metre);
    v("way_per_radian", way_per_radian);
    v("turn_per_metre", turn_per_metre);
    v("turn_per_radian", turn_per_radian);
    v("least", least);
    v("window", window);
    v("still", still);
  }
};

/// After an iteration: what may be drawn, and whether to go on.
struct EmProgress {
  int level = 0;
  int iteration = 0;            ///< 0: the blind one
  double log_likelihood = 0.0;  ///< of all data, ln p(d | m), up to a constant of the level
  double moved = 0.0;           ///< [m], mean, since the iteration before
  const EvidenceMap& map;
  std::span<const SeenPlace> places;
  std::span<const Pose2> poses;  ///< map_from_base of each place: modes
};

struct EmMap {
  std::vector<std::size_t> scans;    ///< those that places are seen from
  std::vector<Pose2> map_from_base;  ///< of these
  double log_likelihood = 0.0;
};

/// Concurrent mapping and localization by expectation maximization [Minerva2000] 4.1. E-step: Markov localization of
/// all places forwards and backwards, P(s | all data) by their product; the first time blind, from the origin (eq. 8).
/// M-step: the map of maximum likelihood, each cell by itself (eq. 9). From a coarse grid of poses to a fine one; can
/// be ended after any iteration: `progress` returns false. Every iteration O(places * cells of their beliefs).
[[nodiscard]] EmMap map_by_em(std::span<const MappingScan> scans, const EmMapperParams& params,
                              const std::function<bool(const EmProgress&)>& progress = {});

}  // namespace docent::mapping
