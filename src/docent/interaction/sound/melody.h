#pragma once

#include "docent/interaction/sound/clip.h"

namespace docent::interaction {

/// What the robot plays while it drives where the museum brings no music of its own: a walking tune of eight bars for a
/// plucked voice and a bass, written for Docent. It ends as it begins, so that it can be played round and round. The
/// melody lies from C4 to A5, its loudest sample at half of full scale. Always the same samples.
[[nodiscard]] Clip melody_clip();

}  // namespace docent::interaction
