#pragma once

#include <filesystem>

#include "docent/base/result.h"
#include "docent/base/yaml.h"
#include "docent/museum/museum_reader.h"

namespace docent::museum {

/// museum.yaml of `folder`. Where there is no such folder, the error names the museums beside it; where it has none,
/// those in it.
[[nodiscard]] Result<YamlFile> load_museum_file(const std::filesystem::path& folder);

/// All that it says, and its texts; that there is no exhibit is a fault, too, unless the museum is being set up.
[[nodiscard]] MuseumSource read_museum_file(const YamlFile& file, const std::filesystem::path& folder, Stage stage);

}  // namespace docent::museum
