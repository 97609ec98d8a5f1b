#pragma once

#include <functional>
#include <string>

#include "docent/apps/laboratory/train_sonar/sonar_worlds.h"
#include "docent/grid/occupancy_grid.h"
#include "docent/mapping/sonar_network/cone_model.h"

namespace docent::apps::train_sonar_command {

/// P(occupied | one view) of places [m] in the base frame.
using SonarModel = std::function<std::vector<double>(const mapping::SonarView&, std::span<const Point2>)>;
[[nodiscard]] SonarModel by_network(const mapping::SonarNetwork& network);
[[nodiscard]] SonarModel by_cones(const mapping::ConeModelParams& params);

/// A map of all views, fused by Bayes' rule ([Rhino1999] eq. 17-18): the sum of the models' log odds less the prior's.
struct SonarMap {
  GridFrame frame;
  std::vector<double> log_odds;  ///< [rows * columns]
  std::vector<bool> seen;        ///< within reach of a view
};
[[nodiscard]] SonarMap integrated(const SonarWorld& world, std::span<const SonarPlace> places, const SonarModel& model,
                                  double prior, double reach);

/// One model in one world it has not been trained in.
struct SonarScore {
  std::size_t examples = 0;
  double cross_entropy = 0.0;  ///< [nat] of single views
  double roc_area = 0.0;       ///< of single views
  std::size_t cells = 0;
  double map_roc_area = 0.0;  ///< of the integrated map
};
[[nodiscard]] SonarScore score_sonar(const SonarWorld& world, std::uint64_t seed, const SonarModel& model, double prior,
                                     double reach);

}  // namespace docent::apps::train_sonar_command
