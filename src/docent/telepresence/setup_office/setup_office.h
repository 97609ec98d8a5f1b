#pragma once

#include <filesystem>
#include <functional>

#include "docent/museum/editing/museum_setup.h"
#include "docent/telepresence/setup_office/setup_documents.h"

namespace docent::telepresence {

/// Where a technician sets up the robot's museum.
struct SetupOffice {
  std::filesystem::path folder;  ///< of the museum
  museum::MuseumSetup setup;     ///< of it
  /// Any thread: what the robot shall do that maps the museum.
  std::function<void(ExplorationOrder)> order;
  /// Any thread: all modules shall begin anew, for the step that has come.
  std::function<void()> move;
};

[[nodiscard]] Result<documents::SetupState> state_of(const SetupOffice& office);

}  // namespace docent::telepresence
