#pragma once

#include "docent/modules/shared/module.h"

namespace docent::modules {

/// `sound`: says what is ordered, one line at a time. In virtual time the words alone, with a foretold duration; else
/// espeak-ng renders them to state/audio/HASH.wav, where the sound of the horn lies too (horn.h); `sound.player` plays
/// both on the robot. Checkpoint: state/sound.json.
[[nodiscard]] Result<std::unique_ptr<Module>> make_sound(const ModuleContext& context);
[[nodiscard]] Result<robot::ParameterRows> parameters_of_sound(const robot::RobotConfig& config);

}  // namespace docent::modules
