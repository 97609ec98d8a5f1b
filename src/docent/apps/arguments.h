#pragma once

#include <string>
#include <vector>

#include "docent/geometry/pose2.h"

namespace docent {

/// "1.5,-2" and the like, exactly `count` numbers; CommandFailed naming the option otherwise.
[[nodiscard]] std::vector<double> parse_numbers(const std::string& option, const std::string& text, std::size_t count);
[[nodiscard]] Point2 parse_point(const std::string& option, const std::string& text);  ///< X,Y [m]
[[nodiscard]] Pose2 parse_pose(const std::string& option, const std::string& text);    ///< X,Y,DEG

}  // namespace docent
