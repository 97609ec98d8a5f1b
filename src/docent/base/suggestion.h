#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace docent {

/// "; did you mean 'reach'?" for a misspelt word, "" where no word of `known` is near: at most a third of its letters,
/// and at least one, may be wrong, missing, superfluous or exchanged with their neighbour. O(|word| |known|).
[[nodiscard]] std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace docent
