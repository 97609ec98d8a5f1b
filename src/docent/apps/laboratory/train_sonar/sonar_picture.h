#pragma once

#include "docent/apps/laboratory/train_sonar/sonar_score.h"
#include "docent/pictures/figure.h"

namespace docent::apps::train_sonar_command {

/// [Rhino1999] Fig. 10b: a view of the sonars and what a model makes of it, and the map of many views, for two models.
[[nodiscard]] pictures::Figure draw_sonar_models(const SonarWorld& world, std::uint64_t seed, const SonarModel& network,
                                                 double network_prior, const SonarModel& cones, double cones_prior,
                                                 double reach);

}  // namespace docent::apps::train_sonar_command
