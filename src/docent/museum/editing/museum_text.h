#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "docent/base/result.h"
#include "docent/museum/editing/museum_draft.h"
#include "docent/museum/museum_reader.h"

namespace docent::museum {

inline constexpr const char* kMuseumFile = "museum.yaml";

/// Files of a museum's folder, named relative to it, with their content.
using FolderFiles = std::map<std::filesystem::path, std::string>;

/// As it is written in museum.yaml: to the millimetre and a tenth of a degree.
[[nodiscard]] std::string yaml_of(const Pose2& pose);
[[nodiscard]] std::string yaml_of(const Polygon& polygon);
[[nodiscard]] std::string yaml_of(const Hazard& hazard);
[[nodiscard]] std::string yaml_of(const Translations& texts);
[[nodiscard]] std::string yaml_of(const Tour& tour);
[[nodiscard]] std::string yaml_of(const Room& room);

struct EditedMuseum {
  FolderFiles files;          ///< those that change
  std::vector<Error> faults;  ///< of form, that the draft has; then nothing should be written
};

/// What must be written so that the museum becomes what the draft says. Lines of museum.yaml that say nothing else
/// remain as they are, with their comments. Error: museum.yaml itself cannot be read.
/// @param yaml  the content of museum.yaml
[[nodiscard]] Result<EditedMuseum> edit_museum(const std::string& yaml, const ReadText& read_text,
                                               const MuseumDraft& draft);

}  // namespace docent::museum
