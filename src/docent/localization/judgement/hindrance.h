#pragma once

#include <string>

#include "docent/localization/judgement/verdict.h"

namespace docent::localization {

/// What keeps a robot from saying where it is, for its technician: the gravest of what Verdict asks for, in one clause
/// with its figure. Empty: nothing does. A contradiction comes first, for it does not go away by looking round.
[[nodiscard]] std::string hindrance_of(const Doubt& doubt, const VerdictParams& params);

}  // namespace docent::localization
