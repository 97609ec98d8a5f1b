#pragma once

#include <array>
#include <string_view>

namespace docent::apps {

/// The commands that `docent-lab` has and `docent` has not, so that `docent` can name the right program.
inline constexpr std::array<std::string_view, 10> kLaboratoryCommands{
    "attract", "crowd", "evaluate",  "follow-ceiling", "learn-sensor-model",
    "plan",    "rooms", "score-map", "take-pictures",  "train-sonar"};

}  // namespace docent::apps
