#pragma once

#include <string_view>
#include <vector>

#include "docent/base/result.h"

namespace docent::simulator {

/// The finite numbers of a line of text, separated by blanks, tabs or commas. Error: what stands there instead.
[[nodiscard]] Result<std::vector<double>> numbers_of(std::string_view line);

/// Calls f(line, number) for each line that is neither empty nor a comment (# or %) until f returns false; lines count
/// from 1, carriage returns are cut.
template <class F>
void for_each_line(std::string_view text, F&& f) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || line[first] == '#' || line[first] == '%') continue;
    if (!f(line.substr(first), number)) return;
  }
}

}  // namespace docent::simulator
