#pragma once

#include <string>
#include <vector>

#include "docent/localization/learning/bootstrap.h"

namespace docent::apps::learn_command {

/// What was learned, beside what it was learned from and instead of.
struct LearningOutcome {
  std::string sensor;                          ///< laser, sonar
  std::vector<std::string> logs;               ///< files
  std::string map;                             ///< file or museum folder
  sensor_models::ProximityModelParams before;  ///< of that sensor
  motion_models::OdometryModelParams motion_before;
  localization::LearnedModels learned;
};

/// Tables for the terminal: iterations, parameters before and after, held-out likelihoods.
[[nodiscard]] std::string learning_table(const LearningOutcome& outcome);
/// A robot.yaml with section `localize`; its keys are those of the parameter structs.
[[nodiscard]] std::string learned_yaml(const LearningOutcome& outcome);
/// The same as options of `docent localize`.
[[nodiscard]] std::string learned_settings(const LearningOutcome& outcome);
[[nodiscard]] std::string learning_json(const LearningOutcome& outcome);

}  // namespace docent::apps::learn_command
