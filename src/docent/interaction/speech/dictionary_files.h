#pragma once

#include <string_view>
#include <utility>
#include <vector>

namespace docent::interaction {

/// Code of the language and text of each file languages/CODE.yaml, as they were at the build (see CMakeLists.txt).
[[nodiscard]] const std::vector<std::pair<std::string_view, std::string_view>>& dictionary_files();

}  // namespace docent::interaction
