#pragma once

#include <string>

#include "docent/interaction/attract/crowd_class.h"
#include "docent/interaction/attract/trial_memory.h"
#include "docent/pictures/figure.h"

namespace docent::apps::attract_command {

/// [Minerva2000] Fig. 15: the mean reward of each style, from friendly on the left to upset on the right, with its 95 %
/// interval and the number of phases; for all crowds, and for each class of crowds.
/// @param claim  what the learner says of it, for the title
[[nodiscard]] pictures::Figure draw_styles(const interaction::TrialMemory& trials,
                                           const interaction::CrowdClassParams& crowds, const std::string& claim);

}  // namespace docent::apps::attract_command
