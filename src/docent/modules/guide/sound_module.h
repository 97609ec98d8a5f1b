#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `sound`: says what is ordered, one line at a time, sounds the horn, and plays music while the task drives or as
/// docent/music orders. Lines are recordings of the museum or rendered by espeak-ng to state/audio/HASH.wav, where horn
/// and music lie too, for the pages; `sound.output` brings the mix of all to a sound card or into a file. In virtual
/// time it says the words alone, with a foretold duration, unless a file is to hold the mix. Checkpoint:
/// state/sound.json.
[[nodiscard]] Result<std::unique_ptr<Module>> make_sound(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_sound(const robot::RobotConfig& config);

}  // namespace docent::modules
