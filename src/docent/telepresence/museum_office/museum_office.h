#pragma once

#include <functional>

#include "docent/museum/editing/museum_workshop.h"
#include "docent/telepresence/museum_office/museum_documents.h"

namespace docent::telepresence {

/// Where operators change the robot's museum.
struct MuseumOffice {
  museum::MuseumWorkshop workshop;
  /// Any thread: the stop button is pressed. Without it nothing changes under a robot that drives.
  std::function<bool()> is_stopped;
  /// Any thread: all modules shall begin anew, in the trial or in the published museum.
  std::function<void(bool into_trial)> move;
  /// What people have recorded for the robot of that museum, and what they may; empty: nobody can say.
  std::function<documents::MuseumRecordings(const museum::Museum& museum)> recordings = {};
};

[[nodiscard]] documents::MuseumDraft document_of(const museum::MuseumDraft& draft);
[[nodiscard]] museum::MuseumDraft draft_of(const documents::MuseumDraft& document);

}  // namespace docent::telepresence
