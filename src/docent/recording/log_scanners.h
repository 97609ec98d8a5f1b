#pragma once

#include <span>
#include <string>

#include "docent/recording/laser_log.h"

namespace docent::recording {

/// Settles what the drivers of a recording meant, now that all of it is known. `frames`: [scans] of which scanner each
/// is. Readings of exactly 0 are those that were written so; notes say what was found.
///
/// - A driver that writes 0 where nothing comes back: these become +infinity (`ZeroMeaning`), others
/// NaN.
/// - What a scanner sees of the robot, beams that read the same near thing while the robot drove: NaN.
/// - A scanner that never answered from as far off as its driver says: its reach is what it did answer from.
void settle_scanners(LaserLog& log, std::span<const std::string> frames);

}  // namespace docent::recording
