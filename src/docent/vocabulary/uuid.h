#pragma once

#include <string>

#include "docent/base/random.h"
#include "docent/base/time.h"

namespace docent {

/// RFC 9562 version 7 from a time and random bits. @pre time >= 0
[[nodiscard]] std::string make_uuid_v7(Time time, Rng& rng);

}  // namespace docent
