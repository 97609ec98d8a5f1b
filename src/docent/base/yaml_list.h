#pragma once

#include <cstdio>
#include <span>
#include <string>

namespace docent {

/// "[1, 0.25]", as `read_yaml` reads it: numbers for a file of YAML, nine digits of each; they must be finite.
[[nodiscard]] inline std::string yaml_list(std::span<const double> values) {
  std::string text = "[";
  for (const double value : values) {
    char number[40];
    std::snprintf(number, sizeof number, "%s%.9g", text.size() > 1 ? ", " : "", value);
    text += number;
  }
  return text + "]";
}

}  // namespace docent
