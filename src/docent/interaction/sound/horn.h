#pragma once

#include "docent/interaction/sound/clip.h"
#include "docent/interaction/sound/sound_file.h"

namespace docent::interaction {

/// The sound of the horn: two short blasts of two tones, F4 (349.23 Hz) and A4 (440 Hz), at most half of full scale.
[[nodiscard]] Clip horn_clip();

/// The same to fetch. Every process makes the same sound and so knows its name.
[[nodiscard]] SharedSound horn_sound();

}  // namespace docent::interaction
