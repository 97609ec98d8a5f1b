#pragma once

#include "docent/museum/museum.h"
#include "docent/telepresence/museum_office/museum_documents.h"

namespace docent::modules {

/// What people have recorded for the museum's robot, and what they may. Reads the names in FOLDER/content/audio.
[[nodiscard]] telepresence::documents::MuseumRecordings recordings_of(const museum::Museum& museum);

}  // namespace docent::modules
