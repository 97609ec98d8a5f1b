#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "docent/base/result.h"

namespace docent::evaluation {

/// Lines of as many numbers as `columns` names words, e.g. "time x y theta"; "#" begins a comment, empty lines are
/// passed over. Error: "NAME:LINE: …".
[[nodiscard]] Result<std::vector<std::vector<double>>> parse_number_lines(std::string_view text,
                                                                          const std::string& name,
                                                                          const std::string& columns);

}  // namespace docent::evaluation
