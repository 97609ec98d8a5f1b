#pragma once

#include <filesystem>

#include "docent/base/result.h"
#include "docent/base/yaml.h"

namespace docent::museum {

/// museum.yaml of `folder`. Where there is no such folder, the error names the museums beside it.
[[nodiscard]] Result<YamlFile> load_museum_file(const std::filesystem::path& folder);

}  // namespace docent::museum
