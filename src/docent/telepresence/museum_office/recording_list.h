#pragma once

#include "docent/museum/museum.h"
#include "docent/telepresence/museum_office/museum_documents.h"

namespace docent::telepresence {

/// What people have recorded for the museum's robot, and what they may. Reads the names in FOLDER/content/audio.
[[nodiscard]] documents::MuseumRecordings recordings_of(const museum::Museum& museum);

}  // namespace docent::telepresence
