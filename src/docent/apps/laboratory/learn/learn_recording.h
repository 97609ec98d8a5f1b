#pragma once

#include <string>

#include "docent/localization/learning/bootstrap.h"
#include "docent/recording/laser_log.h"

namespace docent::apps::learn_command {

/// What learning needs of a log. Of a robot that stands only two scans a second are kept: no scan more would count.
/// Readings of `reach` [m] or more count as no return.
[[nodiscard]] localization::LearningRecording learning_recording(const recording::LaserLog& log, double reach,
                                                                 bool with_sonars);

}  // namespace docent::apps::learn_command
